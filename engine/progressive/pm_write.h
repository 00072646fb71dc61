#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "engine/core/progress.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher {

/// Takes the bytes of a file in order, some at a time.
using ByteSink = std::function<void(std::span<const std::byte>)>;

struct PmWriteOptions {
  /// 0: lossless, every float as it is. 4 to 24: all positions are rounded to a grid of so many
  /// bits along the longest side of the box of all levels.
  unsigned coordinate_bits = 0;
  Progress* progress = nullptr;
};

/// What was written, in bytes; `total` is all of it.
struct PmSizes {
  std::uint64_t total = 0;
  std::uint64_t base = 0;    ///< header and base mesh
  std::uint64_t splits = 0;  ///< blocks of splits
};

/// Writes a progressive mesh as docs/pm-format.md says: header, base mesh, then blocks of splits,
/// small ones first, each with a checksum, so that whoever has read the first blocks has a mesh.
/// Leaves `mesh` at its level. Same mesh and options, same bytes. O(F). Throws Cancelled, and
/// whatever the sink throws; OutputError where the format cannot hold it.
PmSizes write_pm(ProgressiveMesh& mesh, const PmWriteOptions& options, const ByteSink& sink);

}  // namespace mesher
