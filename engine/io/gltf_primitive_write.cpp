#include "engine/io/gltf_primitive_write.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/io/gltf_mesh.h"
#include "engine/io/gltf_types.h"

namespace mesher::io {
namespace {

using Json = nlohmann::json;

/// An index of 65535 would restart a strip.
constexpr std::size_t kMostShortVertices = 65535;

std::size_t padded_bytes(const AttributeType& type) {
  return (type.value_bytes() + 3) / 4 * 4;
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Adds the least and the largest value of each component, which glTF asks for in positions.
void add_range(GltfArray& array) {
  constexpr float kMost = std::numeric_limits<float>::max();
  float least[3] = {kMost, kMost, kMost};
  float largest[3] = {-kMost, -kMost, -kMost};
  for (std::size_t i = 0; i < array.bytes.size() / sizeof(float); ++i) {
    float value;
    std::memcpy(&value, array.bytes.data() + i * sizeof(float), sizeof value);
    least[i % 3] = std::min(least[i % 3], value);
    largest[i % 3] = std::max(largest[i % 3], value);
  }
  array.json["min"] = least;
  array.json["max"] = largest;
}

bool has_array(const std::vector<GltfArray>& arrays, const std::string& name) {
  return std::ranges::find(arrays, name, &GltfArray::name) != arrays.end();
}

bool is_of_target(const AttributeLayer& layer) {
  return layer.type().kind == AttributeKind::delta;
}

}  // namespace

GltfPrimitiveMaker::GltfPrimitiveMaker(const GltfLevel& level)
    : mesh_(*level.mesh), attributes_(*level.attributes) {
  faces_.resize(attributes_.groups.size());
  for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
    faces_[attributes_.group[f]].push_back(f);
  number_.resize(mesh_.vertex_count() + attributes_.further.size(), kNone);
}

std::size_t GltfPrimitiveMaker::group_of(std::size_t primitive) const {
  const auto& groups = attributes_.groups;
  const auto found = std::ranges::lower_bound(groups, primitive, {}, &FaceGroup::primitive);
  const bool is_there = found != groups.end() && found->primitive == primitive;
  return static_cast<std::size_t>((is_there ? found : groups.end()) - groups.begin());
}

GltfPrimitiveArrays GltfPrimitiveMaker::make(std::size_t primitive, const Json& original) {
  GltfPrimitiveArrays arrays;
  find_vertices(group_of(primitive));
  if (corners_.empty()) return arrays;
  arrays.indices = indices();
  arrays.attributes.push_back(positions());
  add_attributes(original, arrays);
  add_targets(original, arrays);
  return arrays;
}

void GltfPrimitiveMaker::find_vertices(std::size_t group) {
  for (const std::uint32_t w : wedges_)
    number_[w] = kNone;
  wedges_.clear();
  corners_.clear();
  for (const std::uint32_t f : faces_[group]) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t w =
          attributes_.wedge(mesh_.origins(), Mesh::halfedge(Face(f), c)).index();
      if (number_[w] == kNone) {
        number_[w] = static_cast<std::uint32_t>(wedges_.size());
        wedges_.push_back(w);
      }
      corners_.push_back(number_[w]);
    }
  }
}

GltfArray GltfPrimitiveMaker::positions() const {
  GltfArray array;
  array.name = "POSITION";
  for (const std::uint32_t w : wedges_)
    append(array.bytes, mesh_.position(attributes_.vertex(Wedge(w), mesh_.vertex_count())));
  array.json = {{"componentType", gltf_number(ComponentType::f32)},
                {"count", wedges_.size()},
                {"type", "VEC3"}};
  add_range(array);
  return array;
}

GltfArray GltfPrimitiveMaker::indices() const {
  GltfArray array;
  const bool is_short = wedges_.size() <= kMostShortVertices;
  for (const std::uint32_t corner : corners_) {
    if (is_short) {
      append(array.bytes, static_cast<std::uint16_t>(corner));
    } else {
      append(array.bytes, corner);
    }
  }
  array.json = {{"componentType", gltf_number(is_short ? ComponentType::u16 : ComponentType::u32)},
                {"count", corners_.size()},
                {"type", "SCALAR"}};
  return array;
}

GltfArray GltfPrimitiveMaker::array_of(const AttributeLayer& layer, const std::string& name) const {
  const AttributeType& type = layer.type();
  GltfArray array;
  array.name = name;
  const std::size_t padding = padded_bytes(type) - type.value_bytes();
  for (const std::uint32_t w : wedges_) {
    const auto value = layer.value(w);
    array.bytes.append(reinterpret_cast<const char*>(value.data()), value.size());
    array.bytes.append(padding, '\0');
  }
  if (padding > 0) array.stride = padded_bytes(type);
  array.json = {{"componentType", gltf_number(type.component)},
                {"count", wedges_.size()},
                {"type", gltf_shape(type.components)}};
  if (type.is_normalized) array.json["normalized"] = true;
  return array;
}

bool GltfPrimitiveMaker::has_all_values(const AttributeLayer& layer) const {
  return std::none_of(wedges_.begin(), wedges_.end(),
                      [&](std::uint32_t w) { return is_absent(layer, w); });
}

/// A layer that the primitive did not have belongs to others, unless an edit has made it.
void GltfPrimitiveMaker::add_attributes(const Json& original, GltfPrimitiveArrays& arrays) const {
  const Json& names = original["attributes"];
  bool has_normals = false;
  for (const AttributeLayer& layer : attributes_.layers) {
    const std::string& name = layer.type().name;
    const bool is_made = layer.type().kind == AttributeKind::normal;
    if (is_of_target(layer) || (!names.contains(name) && !is_made)) continue;
    if (!has_all_values(layer)) continue;
    has_normals |= name == "NORMAL";
    arrays.attributes.push_back(array_of(layer, name));
  }
  // Tangents mean nothing without normals.
  if (!has_normals)
    std::erase_if(arrays.attributes, [](const GltfArray& a) { return a.name == "TANGENT"; });
  for (const auto& [name, accessor] : names.items()) {
    if (!has_array(arrays.attributes, name)) arrays.missing.push_back(name);
  }
}

void GltfPrimitiveMaker::add_targets(const Json& original, GltfPrimitiveArrays& arrays) const {
  const auto targets = original.find("targets");
  if (targets == original.end()) return;
  for (std::size_t t = 0; t < targets->size(); ++t) {
    std::vector<GltfArray>& target = arrays.targets.emplace_back();
    for (const auto& [key, accessor] : (*targets)[t].items()) {
      const AttributeLayer* layer = attributes_.find(morph_layer(t, key));
      const bool has_base = has_array(arrays.attributes, key);
      if (layer == nullptr || !has_base || !has_all_values(*layer)) {
        arrays.missing.push_back(morph_layer(t, key));
        continue;
      }
      target.push_back(array_of(*layer, key));
      if (key == "POSITION") add_range(target.back());
    }
  }
}

}  // namespace mesher::io
