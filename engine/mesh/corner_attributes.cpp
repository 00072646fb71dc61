#include "engine/mesh/corner_attributes.h"

#include <span>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/wedges.h"

namespace mesher {
namespace {

constexpr std::size_t kCornerGrain = std::size_t{1} << 15;

/// Copies the values of a layer to an array per corner, converted by `convert`.
template <class T, class Convert>
Array<T> spread(const Mesh& mesh, const Attributes& attributes, const AttributeLayer* layer,
                const Convert& convert) {
  Array<T> values;
  if (layer == nullptr) return values;
  values.resize(mesh.halfedge_count());
  parallel_for_each(mesh.halfedge_count(), kCornerGrain, [&](std::uint32_t h) {
    values[h] = convert(*layer, attributes.wedge(mesh.origins(), Halfedge(h)).index());
  });
  return values;
}

glm::vec2 texcoord_at(const AttributeLayer& layer, std::size_t w) {
  const AttributeValue value = load(layer, w);
  const glm::vec2 texcoord(value[0], value[1]);
  return layer.type().counts_down ? glm::vec2(texcoord.x, 1.0F - texcoord.y) : texcoord;
}

glm::u8vec4 color_at(const AttributeLayer& layer, std::size_t w) {
  AttributeValue value = load(layer, w);
  if (layer.type().components < 4) value[3] = 1.0;
  AttributeLayer bytes(color_type(), 1);
  store(bytes, 0, value);
  return bytes.values<glm::u8vec4>()[0];
}

}  // namespace

CornerAttributes to_corners(const Mesh& mesh, const Attributes& attributes) {
  CornerAttributes corners;
  corners.texcoord =
      spread<glm::vec2>(mesh, attributes, attributes.find("TEXCOORD_0"), texcoord_at);
  corners.normal = spread<glm::vec3>(mesh, attributes, attributes.find("NORMAL"),
                                     [](const AttributeLayer& layer, std::size_t w) {
                                       const AttributeValue value = load(layer, w);
                                       return glm::vec3(value[0], value[1], value[2]);
                                     });
  corners.color = spread<glm::u8vec4>(mesh, attributes, attributes.find("COLOR_0"), color_at);
  const AttributeLayer* color = attributes.find("COLOR_0");
  corners.has_linear_color = color != nullptr && color->type().is_linear;
  corners.group = attributes.group;
  corners.groups = attributes.groups;
  return corners;
}

Attributes to_wedges(const Mesh& mesh, CornerAttributes&& corners) {
  std::vector<AttributeLayer> layers;
  const auto take = [&](AttributeType type, const auto& values) {
    if (!values.empty()) layers.emplace_back(std::move(type), std::span(values));
  };
  take(texcoord_type(), corners.texcoord);
  take(normal_type(), corners.normal);
  AttributeType color = color_type();
  color.is_linear = corners.has_linear_color;
  take(color, corners.color);
  Attributes attributes;
  set_corner_layers(mesh, attributes, std::move(layers));
  attributes.group = std::move(corners.group);
  attributes.groups = std::move(corners.groups);
  return attributes;
}

}  // namespace mesher
