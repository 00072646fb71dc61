#pragma once

#include "engine/io/mapped_file.h"
#include "engine/mesh/soup.h"

namespace mesher {

/// Reads glTF 2.0, text (.gltf, buffers within or beside it) or binary (.glb): the triangles of the
/// default scene, each mesh placed by its nodes, with normals, texture coordinates (turned so that
/// they count from the bottom, as in OBJ) and colours. Vertices of one mesh at bitwise equal places
/// are joined: glTF splits them where attributes differ, and the surface would fall apart. The node
/// and material name the group of a face. Points, lines, skins and morphs are passed over.
///
/// Ours rather than a library's: the one that Debian has is known to crash on hostile files, and
/// every answer here comes from checked bytes. Cycles and nodes with two parents are refused, and
/// so are repeated meshes that would swell a small file beyond sense. O(bytes + output log output).
/// Throws InputError.
Soup read_gltf(const MappedFile& file);

}  // namespace mesher
