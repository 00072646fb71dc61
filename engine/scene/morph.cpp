#include "engine/scene/morph.h"

#include <algorithm>
#include <charconv>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>
#include <vector>

namespace mesher::scene {
namespace {

/// What a morph target adds to an attribute.
struct Target {
  std::size_t number;
  const AttributeLayer* layer;
};

/// Returns the change of a value by all targets with a weight.
glm::dvec3 change_of(const std::vector<Target>& targets, const std::vector<double>& weights,
                     std::size_t i) {
  glm::dvec3 change(0.0);
  for (const auto& [number, layer] : targets) {
    if (number >= weights.size() || weights[number] == 0.0 || is_absent(*layer, i)) continue;
    const AttributeValue value = load(*layer, i);
    change += weights[number] * glm::dvec3(value[0], value[1], value[2]);
  }
  return change;
}

/// Returns the layers of an attribute, which are named "target 0 POSITION".
std::vector<Target> targets_of(const Attributes& attributes, std::string_view attribute) {
  constexpr std::string_view kStart = "target ";
  std::vector<Target> targets;
  for (const AttributeLayer& layer : attributes.layers) {
    const std::string_view name = layer.type().name;
    if (layer.type().kind != AttributeKind::delta || !name.starts_with(kStart)) continue;
    const char* const end = name.data() + name.size();
    std::size_t number = 0;
    const auto [rest, error] = std::from_chars(name.data() + kStart.size(), end, number);
    if (error == std::errc() && rest != end && std::string_view(rest + 1, end) == attribute)
      targets.push_back({number, &layer});
  }
  return targets;
}

void change_positions(const std::vector<std::vector<double>>& weights, Copies& copies) {
  const std::vector<Target> targets = targets_of(copies.shape.attributes, "POSITION");
  MeshArrays arrays = MeshArrays::take(std::move(copies.shape.mesh));
  for (std::size_t v = 0; v < arrays.position.size(); ++v) {
    if (copies.of_vertex[v] == kNone) continue;
    const glm::dvec3 change = change_of(targets, weights[copies.of_vertex[v]], v);
    const glm::vec3 p(glm::dvec3(arrays.position[v]) + change);
    if (change != glm::dvec3(0.0) && is_finite(p)) arrays.position[v] = p;
  }
  copies.shape.mesh = std::move(arrays).finish();
}

void change_normals(const std::vector<std::vector<double>>& weights, Copies& copies) {
  const std::vector<Target> targets = targets_of(copies.shape.attributes, "NORMAL");
  const std::uint32_t vertices = copies.shape.mesh.vertex_count();
  for (AttributeLayer& normals : copies.shape.attributes.layers) {
    if (normals.type().kind != AttributeKind::normal) continue;
    for (std::uint32_t w = 0; w < normals.count(); ++w) {
      const Vertex v = copies.shape.attributes.vertex(Wedge(w), vertices);
      const std::uint32_t copy = copies.of_vertex[v.index()];
      if (copy == kNone || is_absent(normals, w)) continue;
      const AttributeValue before = load(normals, w);
      const glm::dvec3 n =
          glm::dvec3(before[0], before[1], before[2]) + change_of(targets, weights[copy], w);
      const double length = glm::length(n);
      if (length > 0.0) store(normals, w, {n.x / length, n.y / length, n.z / length, 0.0});
    }
  }
}

}  // namespace

void add_targets(const std::vector<std::vector<double>>& weights, Copies& copies) {
  const bool has_any = std::ranges::any_of(weights, [](const std::vector<double>& own) {
    return std::ranges::any_of(own, [](double weight) { return weight != 0.0; });
  });
  if (!has_any) return;
  change_positions(weights, copies);
  change_normals(weights, copies);
}

}  // namespace mesher::scene
