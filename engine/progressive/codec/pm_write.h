#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "engine/core/progress.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// Receives the bytes of a file in order, some at a time.
using ByteSink = std::function<void(std::span<const std::byte>)>;

struct PmWriteOptions {
  /// 0: lossless floats. 4 to 24: all positions are rounded to a grid with this many bits along the
  /// longest side of the bounding box of all levels.
  unsigned coordinate_bits = 0;
  Progress* progress = nullptr;
};

/// Sizes of the written parts in bytes.
struct PmSizes {
  std::uint64_t total = 0;
  std::uint64_t base = 0;    ///< header and base mesh
  std::uint64_t splits = 0;  ///< blocks of splits
};

/// Writes a progressive mesh in the format of docs/pm-format.md: header, base mesh, then blocks of
/// splits with checksums, small blocks first. Any prefix of whole blocks yields a mesh. Leaves
/// `mesh` at its level. The same mesh and options yield the same bytes. O(F). Throws Cancelled,
/// anything that the sink throws, and OutputError if the format cannot represent the mesh.
PmSizes write_pm(ProgressiveMesh& mesh, const PmWriteOptions& options, const ByteSink& sink);

}  // namespace mesher::progressive
