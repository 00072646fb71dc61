#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/core/progress.h"
#include "engine/io/atomic_file.h"
#include "engine/progressive/pm_write.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher {

/// What there is to say of a file with a progressive mesh (docs/pm-format.md).
struct PmSummary {
  std::uint32_t base_vertices = 0;
  std::uint32_t base_faces = 0;
  std::uint32_t splits = 0;            ///< that are there and whole
  std::uint32_t announced_splits = 0;  ///< by the header, whatever came of it
  std::uint32_t vertices = 0;          ///< with all splits that are there
  std::uint32_t faces = 0;
  unsigned coordinate_bits = 0;  ///< 0: lossless
  std::uint64_t bytes = 0;
  std::string damage;  ///< why the rest cannot be used; empty: the file is complete

  double bytes_per_vertex() const { return vertices > 0 ? double(bytes) / vertices : 0.0; }
  /// What the full mesh takes as plain arrays: 12 bytes a vertex, and 12 a face.
  std::uint64_t indexed_bytes() const { return 12 * (std::uint64_t{vertices} + faces); }
};

/// A progressive mesh from a file, at the finest level that is there.
struct PmContents {
  ProgressiveMesh mesh;
  PmSummary summary;
};

/// Whether a name ends in .pm, in any case.
bool has_pm_ending(const std::filesystem::path& file);
/// Whether a file is to be read as a progressive mesh: its name ends in .pm, or it begins like one,
/// or it is a pipe whose name says nothing (a pipe's beginning can be read only once).
bool is_pm_file(const std::filesystem::path& file);

/// Reads a file, or of a pipe what the mesh needs. What lies before damage is the result then, and
/// the summary says so. Throws InputError where there is not even a base; DeviceError where memory
/// runs out; Cancelled.
PmContents read_pm_file(const std::filesystem::path& file, Progress* progress = nullptr);

/// Writes all of it; leaves `mesh` at its level. Does not commit. Throws OutputError.
PmSizes write_pm_file(AtomicFile& file, ProgressiveMesh& mesh, const PmWriteOptions& options);

/// What there is to say of a mesh that was written so.
PmSummary summary_of(const ProgressiveMesh& mesh, const PmWriteOptions& options,
                     const PmSizes& sizes);

}  // namespace mesher
