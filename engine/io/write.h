#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>

#include "engine/core/progress.h"
#include "engine/io/atomic_file.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/material.h"
#include "engine/mesh/mesh.h"

namespace mesher::io {

struct FormatInfo;

struct WriteOptions {
  bool ascii = false;       ///< PLY and STL as text rather than little-endian binary
  bool compresses = false;  ///< glTF by EXT_meshopt_compression
  /// Added to every position.
  glm::dvec3 origin{0.0};
  /// What the groups refer to; null: there are no materials.
  std::shared_ptr<const Materials> materials = nullptr;
  Progress* progress = nullptr;
  Flush flush = Flush::later;  ///< as for AtomicFile::commit
};

/// Writes a mesh in the format of the file's extension, with the attributes and creases that the
/// format can store.
///
/// losses_in_format lists what is not preserved. Writes a temporary file beside the target and
/// renames it, so that the file appears whole or not at all. Positions preserve every bit in
/// formats with single precision. Throws OutputError; UsageError as writable_format does;
/// Cancelled, and then the target is unchanged. O(V + F).
void write_model(const std::filesystem::path& file, const Mesh& mesh, const Attributes& attributes,
                 const WriteOptions& options = {});

/// Returns the format that write_model uses for a file. Throws UsageError if the extension is
/// unknown, or if it names progressive meshes, which write_pm_file writes.
const FormatInfo& writable_format(const std::filesystem::path& file);

}  // namespace mesher::io
