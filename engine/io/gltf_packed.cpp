#include "engine/io/gltf_packed.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "engine/mesh/ids.h"

namespace mesher::io {
namespace {

using Json = GltfFile::Json;

/// Decoded values that are kept for further instances of their meshes.
constexpr std::size_t kMostPackedValues = std::size_t{1} << 27;

/// Turns integers that the document declares as fractions into fractions.
void scale_integers(const GltfFile& gltf, const Json& primitive, PackedPrimitive& packed) {
  const auto attributes = primitive.find("attributes");
  if (attributes == primitive.end() || !attributes->is_object()) return;
  for (const auto& [name, number] : packed.names) {
    DracoAttribute& attribute = packed.mesh.attributes[number];
    const auto accessor = gltf.find_number(*attributes, name.c_str());
    const double full = accessor ? gltf.full_value(*accessor) : 0.0;
    if (attribute.is_fraction || full == 0.0) continue;
    for (float& value : attribute.values)
      value = static_cast<float>(std::max(-1.0, double(value) / full));
  }
}

PackedPrimitive decoded(GltfFile& gltf, const Json& extension, Progress* progress) {
  const auto attributes = extension.find("attributes");
  if (attributes == extension.end() || !attributes->is_object()) {
    gltf.fail("Draco data has no attributes");
  }
  PackedPrimitive packed;
  std::vector<std::uint32_t> ids;
  for (const auto& [name, id] : attributes->items()) {
    if (!id.is_number_unsigned()) gltf.fail("the id of a Draco attribute is not an integer");
    packed.names.emplace(name, ids.size());
    ids.push_back(
        static_cast<std::uint32_t>(std::min<std::uint64_t>(id.get<std::uint64_t>(), kNone)));
  }
  if (!packed.names.contains("POSITION")) gltf.fail("Draco data has no positions");
  const auto view = gltf.find_number(extension, "bufferView");
  std::string problem;
  std::optional<DracoMesh> mesh =
      decode_draco(gltf.plain_view(view.value_or(~std::uint64_t{0})), ids, problem, progress);
  if (!mesh) gltf.fail(problem);
  packed.mesh = std::move(*mesh);
  return packed;
}

}  // namespace

Array<float> PackedPrimitive::values(const std::string& name, std::size_t components,
                                     std::size_t first, std::size_t count) const {
  const DracoAttribute& attribute = mesh.attributes[names.at(name)];
  Array<float> values(count * components);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < components; ++c) {
      values[i * components + c] = c < attribute.components
                                       ? attribute.values[(first + i) * attribute.components + c]
                                       : 1.0F;
    }
  }
  return values;
}

const PackedPrimitive* PackedPrimitives::find(GltfFile& gltf, const Json& primitive,
                                              Progress* progress) {
  const Json* const extension = gltf.extension(primitive, "KHR_draco_mesh_compression");
  if (extension == nullptr) return nullptr;
  const auto known = known_.find(&primitive);
  if (known != known_.end()) return &known->second;
  PackedPrimitive packed = decoded(gltf, *extension, progress);
  scale_integers(gltf, primitive, packed);
  std::size_t values = packed.mesh.indices.size();
  for (const DracoAttribute& attribute : packed.mesh.attributes)
    values += attribute.values.size();
  if (values_ + values > kMostPackedValues) {
    known_.clear();
    values_ = 0;
  }
  values_ += values;
  return &known_.emplace(&primitive, std::move(packed)).first->second;
}

}  // namespace mesher::io
