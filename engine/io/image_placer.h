#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "engine/io/atomic_file.h"
#include "engine/mesh/material.h"

namespace mesher::io {

/// Writes the images of a model beside its file.
class ImagePlacer {
 public:
  ImagePlacer(AtomicFile& main, const Materials& materials) : main_(main), materials_(materials) {}

  /// Returns the path by which the main file refers to an image, and adds the image's file if it is
  /// not there yet.
  ///
  /// A path below the folder stays as it was read. An embedded image gets its own name or
  /// else `usual_name`. A file that exists and differs is never overwritten: the image gets another
  /// name. An image without bytes keeps its path, which may be empty. Throws OutputError.
  const std::string& place(std::uint32_t image, const std::string& usual_name);

 private:
  std::string find_place(const EncodedImage& image, const std::string& usual_name);
  bool take(const std::string& name, const std::string& bytes);

  AtomicFile& main_;
  const Materials& materials_;
  std::map<std::uint32_t, std::string> placed_;
  std::set<std::string> taken_;
};

}  // namespace mesher::io
