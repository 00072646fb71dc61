#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "engine/core/progress.h"
#include "engine/io/atomic_file.h"
#include "engine/mesh/contents.h"
#include "engine/mesh/material.h"
#include "engine/progressive/codec/pm_write.h"
#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::io {

/// Summary of a file with a progressive mesh (docs/pm-format.md).
struct PmSummary {
  std::uint32_t base_vertices = 0;
  std::uint32_t base_faces = 0;
  std::uint32_t splits = 0;            ///< present and complete
  std::uint32_t announced_splits = 0;  ///< according to the header
  std::uint32_t vertices = 0;          ///< after all splits that are present
  std::uint32_t faces = 0;
  unsigned coordinate_bits = 0;  ///< 0: lossless
  std::uint64_t bytes = 0;
  std::uint64_t attribute_bytes = 0;  ///< of them, those of attributes and materials
  std::string damage;                 ///< why the rest is unusable; empty: the file is complete

  double bytes_per_vertex() const { return vertices > 0 ? double(bytes) / vertices : 0.0; }
  /// Returns the size of the full mesh as plain arrays: 12 bytes per vertex and 12 per face.
  std::uint64_t indexed_bytes() const { return 12 * (std::uint64_t{vertices} + faces); }
};

/// A progressive mesh from a file, at the finest level present.
struct PmContents {
  progressive::ProgressiveMesh mesh;
  progressive::ProgressiveAttributes attributes;  ///< at the level of the mesh; may be empty
  std::shared_ptr<const Materials> materials;     ///< null: the file has none
  FileContents contents;
  PmSummary summary;
};

/// Returns whether a name ends in .pm, in any case.
bool has_pm_ending(const std::filesystem::path& file);
/// Returns whether to read a file as a progressive mesh: its name ends in .pm, or it begins like
/// one, or it is a pipe whose name does not tell (the beginning of a pipe can be read only once).
bool is_pm_file(const std::filesystem::path& file);

/// Returns whether a file is a pipe or a socket, which may go on after a progressive mesh.
bool is_pipe(const std::filesystem::path& file);

/// Reads a progressive mesh from a file or a pipe. Reads no more of a pipe than the mesh needs; in
/// a file, bytes after the mesh are damage.
///
/// If the file is damaged, returns the part before the damage and records the damage in the
/// summary. Throws InputError if not even the base mesh is readable; DeviceError if out of memory;
/// Cancelled.
PmContents read_pm_file(const std::filesystem::path& file, Progress* progress = nullptr);

/// Returns the materials that a reader's appendix holds, or null. Lets the groups of the attributes
/// refer to nothing else, and notes in `contents` what the file holds. `file`: as for
/// decode_pm_materials.
std::shared_ptr<const Materials> take_materials(std::span<const std::byte> appendix,
                                                const std::filesystem::path& file,
                                                progressive::ProgressiveAttributes& attributes,
                                                FileContents& contents);

/// Throws InputError if a file that was read is damaged.
void check_intact(const std::filesystem::path& file, const PmSummary& summary);

/// Writes the whole progressive mesh, with the options' attributes, and leaves `mesh` at its level.
/// Does not commit. Throws OutputError.
progressive::PmSizes write_pm_file(AtomicFile& file, progressive::ProgressiveMesh& mesh,
                                   const progressive::PmWriteOptions& options);
/// Same, with the materials of the attributes' groups. Null: there are none.
progressive::PmSizes write_pm_file(AtomicFile& file, progressive::ProgressiveMesh& mesh,
                                   progressive::PmWriteOptions options, const Materials* materials);

/// Returns the summary of a mesh that write_pm_file wrote.
PmSummary summary_of(const progressive::ProgressiveMesh& mesh,
                     const progressive::PmWriteOptions& options, const progressive::PmSizes& sizes);

}  // namespace mesher::io
