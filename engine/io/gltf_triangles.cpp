#include "engine/io/gltf_triangles.h"

#include <nlohmann/json.hpp>
#include <numeric>

#include "engine/mesh/ids.h"

namespace mesher::io {
namespace {

Array<std::uint32_t> unrolled(const Array<std::uint32_t>& list, bool is_strip) {
  Array<std::uint32_t> triangles;
  for (std::size_t i = 2; i < list.size(); ++i) {
    const std::size_t turn = is_strip ? i % 2 : 0;
    const std::size_t first = is_strip ? i - 2 + turn : 0;
    triangles.insert(triangles.end(), {list[first], list[i - 1 - turn], list[i]});
  }
  return triangles;
}

}  // namespace

std::optional<GltfMode> triangle_mode(const GltfFile& gltf, const GltfFile::Json& primitive) {
  const auto triangles = static_cast<std::uint64_t>(GltfMode::triangles);
  const std::uint64_t mode = gltf.find_number(primitive, "mode").value_or(triangles);
  if (mode < triangles || mode > static_cast<std::uint64_t>(GltfMode::fan)) return std::nullopt;
  return static_cast<GltfMode>(mode);
}

Array<std::uint32_t> triangle_indices(GltfFile& gltf, const GltfFile::Json& primitive,
                                      GltfMode mode, std::size_t vertices) {
  Array<std::uint32_t> list;
  if (const auto accessor = gltf.find_number(primitive, "indices")) {
    list = gltf.indices(*accessor);
  } else {
    if (vertices >= kNone) gltf.fail("more elements than 32-bit indices can address");
    list.resize(vertices);
    std::iota(list.begin(), list.end(), 0U);
  }
  for (const std::uint32_t index : list) {
    if (index >= vertices) gltf.fail("vertex index out of range");
  }
  if (mode != GltfMode::triangles) return unrolled(list, mode == GltfMode::strip);
  list.resize(list.size() / 3 * 3);
  return list;
}

}  // namespace mesher::io
