#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/progressive/progressive_mesh.h"

namespace mesher {

/// Reads a progressive mesh (docs/pm-format.md) as its bytes arrive, in pieces of any size: from a
/// file, a pipe, the net. The mesh grows by whole blocks; what is there is valid at any time.
///
/// Nothing that a file says is taken on trust: memory follows the bytes that have arrived.
class PmReader {
 public:
  /// `name`: of the file, for messages.
  explicit PmReader(std::string name);
  ~PmReader();
  PmReader(PmReader&&) noexcept;
  PmReader& operator=(PmReader&&) noexcept;

  /// Whether a file that begins so is meant to be one of these. Needs 8 bytes.
  static bool is_pm(std::span<const std::byte> begin);

  /// Takes the next bytes. Throws InputError (file, byte, reason) where header or base are wrong:
  /// there is no mesh then. A block that is wrong ends the reading: see damage(). So does want
  /// of memory, and throws std::bad_alloc. O(bytes + splits).
  void feed(std::span<const std::byte> bytes);
  /// No more bytes come. Throws InputError where there is no base; where blocks are missing says so
  /// in damage().
  void finish();

  /// The header and the base mesh have arrived.
  bool has_base() const;
  /// Every split that the header announces has arrived.
  bool is_complete() const;
  /// Why the rest cannot be used ("byte 1,234: checksum of a block is wrong; 5,000 of 8,000 splits
  /// were read"); empty where nothing is wrong so far.
  std::string_view damage() const;
  /// How many splits the header announces (never trusted for more than a progress bar).
  std::uint32_t announced_splits() const;
  /// 0: lossless.
  unsigned coordinate_bits() const;

  /// At its finest level after each `feed` unless the caller moves it; `feed` goes up first. Pre:
  /// has_base().
  ProgressiveMesh& mesh();
  /// Takes the mesh away. Pre: has_base(). Nothing may be fed afterwards.
  ProgressiveMesh take() &&;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mesher
