#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// Reads a progressive mesh (docs/pm-format.md) while its bytes arrive, in pieces of any size: from
/// a file, a pipe, or the network. The mesh grows by whole blocks and is valid at any time.
///
/// The reader does not trust the file: it allocates memory only in proportion to what has been
/// decoded, at most 256 bytes per split if their number is known (expect_splits), and 32 more if
/// edges and vertices are sharp. Attributes take memory in proportion to their bytes.
class PmReader {
 public:
  /// `name`: name of the file, for messages.
  explicit PmReader(std::string name);
  ~PmReader();
  PmReader(PmReader&&) noexcept;
  PmReader& operator=(PmReader&&) noexcept;

  /// Returns whether a file that begins like this is a progressive mesh. Needs 8 bytes.
  static bool is_pm(std::span<const std::byte> begin);

  /// Lets anything follow the last split: the mesh is from a pipe that goes on. Otherwise, bytes
  /// that follow are damage.
  void ignore_what_follows();
  /// Returns how many splits the blocks of a whole file hold, by their headers, without decoding
  /// them. 0 if it has no complete base. O(blocks).
  static std::uint32_t count_splits(std::span<const std::byte> file);
  /// Says how many splits will follow, so that exactly the memory for them is allocated. Without
  /// it, the arrays grow with the splits that arrive.
  void expect_splits(std::uint32_t splits);

  /// Reads the next bytes. O(bytes + splits). Throws InputError (file, byte, reason) if header or
  /// base are invalid; there is no mesh then. An invalid block ends the reading: see damage().
  /// Running out of memory also ends it, and throws std::bad_alloc.
  void feed(std::span<const std::byte> bytes);
  /// Declares the end of the input. Throws InputError if there is no base; reports missing blocks
  /// in damage().
  void finish();

  /// Returns whether the header and the base mesh have arrived.
  bool has_base() const;
  /// Returns whether every split announced by the header has arrived.
  bool is_complete() const;
  /// Returns why the rest cannot be used ("byte 1,234: checksum of a block is wrong; 5,000 of 8,000
  /// splits were read"); empty if nothing is wrong so far.
  std::string_view damage() const;
  /// Returns the number of bytes that the mesh read so far has taken.
  std::uint64_t used_bytes() const;
  /// Returns the number of splits announced by the header. Use it for progress bars only.
  std::uint32_t announced_splits() const;
  /// Returns the bits per coordinate; 0: lossless.
  unsigned coordinate_bits() const;

  /// Returns the mesh. `feed` first goes to the finest level and leaves the mesh there; in between,
  /// the caller may change the level. Pre: has_base().
  ProgressiveMesh& mesh();
  /// Returns the attributes, which are empty if the file has none. As for `mesh`, at the same level
  /// after `feed`. Pre: has_base().
  ProgressiveAttributes& attributes();
  /// Returns what the file holds beside the attributes (PmWriteOptions::appendix). Pre: has_base().
  std::span<const std::byte> appendix() const;
  /// Returns how many of used_bytes() a file without attributes would not have.
  std::uint64_t attribute_bytes() const;
  /// Moves the mesh out. Feed nothing afterward. Pre: has_base().
  ProgressiveMesh take() &&;
  /// Moves the attributes out. Afterward, only the mesh may be taken. Pre: has_base().
  ProgressiveAttributes take_attributes();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mesher::progressive
