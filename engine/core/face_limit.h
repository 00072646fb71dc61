#pragma once

#include <cstdint>
#include <string_view>

namespace mesher {

/// Limits the number of faces of every model that this process reads or makes, while it lives. Pre:
/// no other FaceLimit is alive.
class FaceLimit {
 public:
  /// `most`: number of faces; 0: no limit.
  explicit FaceLimit(std::uint64_t most);
  ~FaceLimit();
  FaceLimit(const FaceLimit&) = delete;
  FaceLimit& operator=(const FaceLimit&) = delete;

  /// Throws InputError, without a file name, if a model of so many faces is too large. Call it as
  /// soon as the number is known, before memory for the faces is allocated. `subject`: what has
  /// them, if it is not the file: "the scene ".
  static void check(std::uint64_t faces, std::string_view subject = {});
};

}  // namespace mesher
