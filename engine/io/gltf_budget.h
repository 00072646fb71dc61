#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "engine/io/gltf_file.h"

namespace mesher::io {

/// Limits what a small file that refers to its data again and again can ask for.
class GltfBudget {
 public:
  /// Cost of visiting a primitive, in values.
  static constexpr std::size_t kPrimitiveCost = 64;
  /// Values that every file may have, however often its meshes are repeated.
  static constexpr std::size_t kAlwaysAllowed = std::size_t{1} << 25;

  /// `refusal`: why a file that asks for too much is refused.
  explicit GltfBudget(
      std::string_view refusal = "its meshes are instanced too often for the size of the file")
      : refusal_(refusal) {}

  /// Adds to the count of values read: corners, vertices, or vertices of a further attribute.
  /// Throws InputError if there are too many for the size of the file, or to count in 32 bits.
  void spend(const GltfFile& gltf, std::size_t values);

 private:
  std::string_view refusal_;
  std::size_t spent_ = 0;
};

/// Returns about how much work it is to read a primitive: its number of indices. Does not judge the
/// document.
double primitive_work(const GltfFile& gltf, const GltfFile::Json& primitive);
/// As above for all primitives of a mesh.
double mesh_work(const GltfFile& gltf, std::uint64_t mesh);

}  // namespace mesher::io
