#pragma once

#include <cstddef>
#include <string>

#include "engine/io/gltf_primitive_write.h"
#include "engine/mesh/attributes.h"

namespace mesher::io {

/// The encoded bytes of an array, with the members of EXT_meshopt_compression.
struct CompressedArray {
  std::string bytes;
  std::string mode;
  std::string filter;  ///< empty: none
  std::size_t count = 0;
  std::size_t stride = 0;
};

/// Encodes an accessor by EXT_meshopt_compression, and changes its JSON to the type in which it is
/// stored (KHR_mesh_quantization). `kind` is that of its values.
///
/// Normals and tangents get 8 bits per component; texture coordinates within [0, 1] and colors get
/// 16. Positions, morph targets and other texture coordinates stay floats that differ by at most
/// 2^-15 of the array's extent, so that no node has to change. Bones, their weights, integers and
/// custom attributes stay as they are, bit for bit. O(size).
CompressedArray compress(GltfArray& array, AttributeKind kind);

/// As above for the indices of triangles. Their order stays; a triangle may begin at another
/// corner.
CompressedArray compress_indices(const GltfArray& indices);

}  // namespace mesher::io
