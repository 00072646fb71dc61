#include "engine/simplify/carry_tangents.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <optional>

#include "engine/core/parallel.h"
#include "engine/mesh/tangents.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kCornerGrain = 4096;
// Tangents agree within ten degrees. Quantized ones are off by one or two.
constexpr float kLeastCosine = 0.985F;
// The input's tangents follow from a set of texture coordinates if so many agree.
constexpr double kLeastAgreement = 0.75;

/// Converts the values of a layer, one per corner. `index`: of each corner.
template <class Value, class Index, class Convert>
Array<Value> by_corner(const AttributeLayer& layer, std::size_t corners, const Index& index,
                       const Convert& convert) {
  Array<Value> values(corners);
  parallel_for_each(corners, kCornerGrain,
                    [&](std::uint32_t h) { values[h] = convert(load(layer, index(Halfedge(h)))); });
  return values;
}

template <class Index>
Array<glm::vec4> tangents_of(const Mesh& mesh, const AttributeLayer& normals,
                             const AttributeLayer& texcoords, const Index& index) {
  const auto normal = [](const AttributeValue& v) {
    const glm::vec3 n(glm::dvec3(v[0], v[1], v[2]));
    const float length = glm::length(n);
    return length > 0.0F ? n / length : n;
  };
  const double up = texcoords.type().counts_down ? -1.0 : 1.0;
  const auto texcoord = [&](const AttributeValue& v) {
    return glm::vec2(glm::dvec2(v[0], up * v[1]));
  };
  const std::size_t corners = mesh.halfedge_count();
  return corner_tangents(mesh, by_corner<glm::vec3>(normals, corners, index, normal),
                         by_corner<glm::vec2>(texcoords, corners, index, texcoord));
}

/// Returns the fraction of the input's corners with a tangent whose tangent is as computed.
double agreement(const Attributed& input, const AttributeLayer& layer,
                 std::span<const glm::vec4> computed) {
  std::size_t corners = 0;
  std::size_t agree = 0;
  for (std::uint32_t i = 0; i < input.mesh.halfedge_count(); ++i) {
    const std::size_t wedge = input.attributes.wedge(input.mesh.origins(), Halfedge(i)).index();
    if (computed[i].w == 0.0F || is_absent(layer, wedge)) continue;
    const AttributeValue value = load(layer, wedge);
    const glm::vec3 tangent(glm::dvec3(value[0], value[1], value[2]));
    const bool has_same_side = value[3] * double{computed[i].w} > 0.0;
    ++corners;
    agree += has_same_side &&
                     glm::dot(tangent, glm::vec3(computed[i])) > kLeastCosine * glm::length(tangent)
                 ? 1
                 : 0;
  }
  return corners > 0 ? static_cast<double>(agree) / static_cast<double>(corners) : 0.0;
}

/// Returns the layer of texture coordinates from which the tangents of the input follow.
std::optional<std::size_t> find_texcoords(const Attributed& input, const AttributeLayer& tangents,
                                          const AttributeLayer& normals) {
  const auto wedge = [&](Halfedge h) {
    return input.attributes.wedge(input.mesh.origins(), h).index();
  };
  for (std::size_t i = 0; i < input.attributes.layers.size(); ++i) {
    const AttributeLayer& layer = input.attributes.layers[i];
    if (layer.type().kind != AttributeKind::texcoord) continue;
    const auto computed = tangents_of(input.mesh, normals, layer, wedge);
    if (agreement(input, tangents, computed) >= kLeastAgreement) return i;
  }
  return std::nullopt;
}

}  // namespace

void rebuild_tangents(const Attributed& input, const Mesh& result, AttributeStream& stream) {
  const std::vector<AttributeLayer>& layers = input.attributes.layers;
  const auto is_normal = [](const AttributeLayer& layer) {
    return layer.type().kind == AttributeKind::normal;
  };
  const auto normals = std::ranges::find_if(layers, is_normal);
  if (normals == layers.end()) return;
  const auto normal_index = static_cast<std::size_t>(normals - layers.begin());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].type().kind != AttributeKind::tangent) continue;
    const std::optional<std::size_t> texcoords = find_texcoords(input, layers[i], *normals);
    if (!texcoords) continue;
    const Array<glm::vec4> computed =
        tangents_of(result, stream.layers[normal_index], stream.layers[*texcoords],
                    [](Halfedge h) { return h.index(); });
    AttributeLayer& to = stream.layers[i];
    parallel_for_each(to.count(), kCornerGrain, [&](std::uint32_t h) {
      const glm::dvec4 tangent(computed[h]);
      if (tangent.w == 0.0 || is_absent(to, h)) return;
      store(to, h, {tangent.x, tangent.y, tangent.z, tangent.w});
    });
  }
}

}  // namespace mesher::simplify
