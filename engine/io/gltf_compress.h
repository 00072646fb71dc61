#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
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

/// The extension, which needs KHR_mesh_quantization as well. Readers must know both.
inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";
inline constexpr const char* kQuantizationExtension = "KHR_mesh_quantization";

/// Adds the views of compressed arrays. Their decoded bytes lie in a buffer without data, the
/// fallback for readers that do not know the extension.
class CompressedViews {
 public:
  /// Returns the JSON of a view, without `buffer` and without the place of the encoded bytes. O(1).
  nlohmann::json add(const CompressedArray& array);
  /// Returns whether there are no views.
  bool is_empty() const { return decoded_bytes_ == 0; }
  /// Returns the JSON of the buffer without data.
  nlohmann::json fallback() const;

 private:
  std::uint64_t decoded_bytes_ = 0;
};

}  // namespace mesher::io
