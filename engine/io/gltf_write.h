#pragma once

#include "engine/io/atomic_file.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Writes glTF 2.0, binary (.glb) or as text with the data inside it (.gltf, one file, whole or not
/// at all): positions, normals where every corner has one, texture coordinates (turned so that they
/// count from the top, as glTF has it; absent ones are 0) and colours. A vertex is repeated where
/// the attributes of its corners differ. Does not commit. O(F). Throws OutputError past 4 GB, which
/// the format cannot hold.
void write_gltf(AtomicFile& file, const Mesh& mesh, const Attributes& attributes, bool binary);

}  // namespace mesher
