#pragma once

#include <filesystem>

#include "engine/io/atomic_file.h"
#include "engine/io/format.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

struct WriteOptions {
  bool ascii = false;  ///< PLY and STL as text rather than little-endian binary
};

/// Writes a mesh in the format of the extension (obj, ply, stl, off, gltf, glb), with attributes
/// and creases where the format can say them. The file appears whole or not at all: it is written
/// beside its target and renamed. Positions keep every bit in formats that hold single precision.
/// Throws OutputError; UsageError for an extension that is not known.
void write_model(const std::filesystem::path& file, const Mesh& mesh, const Attributes& attributes,
                 const WriteOptions& options = {});

/// The same into a file that the caller has opened, and commits.
void write_model(AtomicFile& out, Format format, const Mesh& mesh, const Attributes& attributes,
                 const WriteOptions& options = {});

}  // namespace mesher
