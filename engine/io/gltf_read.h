#pragma once

#include "engine/io/mapped_file.h"
#include "engine/io/read.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Reads glTF 2.0, text (.gltf, with buffers inside or beside it) or binary (.glb).
///
/// Returns the triangles of the default scene with normals, texture coordinates and colors. Each
/// mesh is transformed by its nodes. Texture coordinates are flipped to count from the bottom, as
/// in OBJ. Vertices of one mesh at bitwise equal positions are merged: glTF splits vertices where
/// attributes differ, and the surface would fall apart otherwise. The group of a face holds the
/// name of its node or mesh and its material (engine/io/gltf_materials.h). Skinned meshes are
/// posed by their joints, and morph targets count by their weights: in the pose that the options
/// choose, or as the nodes are. Points and lines are ignored.
///
/// This reader is our own because the library that Debian ships is known to crash on hostile files;
/// here every value comes from checked bytes. Cycles and nodes with two parents are refused. So are
/// repeated meshes that would expand a small file to an unreasonable size. O(bytes + output log
/// output). Throws InputError.
Soup read_gltf(const MappedFile& file, const ReadOptions& options = {});

}  // namespace mesher::io
