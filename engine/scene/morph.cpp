#include "engine/scene/morph.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

namespace mesher::scene {
namespace {

/// Returns the change of a value by all targets with a weight. `layers`: of each target, or null.
glm::dvec3 change_of(const std::vector<const AttributeLayer*>& layers,
                     const std::vector<double>& weights, std::size_t i) {
  glm::dvec3 change(0.0);
  for (std::size_t t = 0; t < std::min(layers.size(), weights.size()); ++t) {
    if (weights[t] == 0.0 || layers[t] == nullptr || is_absent(*layers[t], i)) continue;
    const AttributeValue value = load(*layers[t], i);
    change += weights[t] * glm::dvec3(value[0], value[1], value[2]);
  }
  return change;
}

std::vector<const AttributeLayer*> target_layers(const Attributes& attributes, std::size_t targets,
                                                 const char* what) {
  std::vector<const AttributeLayer*> layers;
  for (std::size_t t = 0; t < targets; ++t)
    layers.push_back(attributes.find("target " + std::to_string(t) + " " + what));
  return layers;
}

void change_positions(const std::vector<std::vector<double>>& weights, std::size_t targets,
                      Copies& copies) {
  const auto layers = target_layers(copies.shape.attributes, targets, "POSITION");
  MeshArrays arrays = MeshArrays::take(std::move(copies.shape.mesh));
  for (std::size_t v = 0; v < arrays.position.size(); ++v) {
    if (copies.of_vertex[v] == kNone) continue;
    const glm::dvec3 change = change_of(layers, weights[copies.of_vertex[v]], v);
    const glm::vec3 p(glm::dvec3(arrays.position[v]) + change);
    if (change != glm::dvec3(0.0) && is_finite(p)) arrays.position[v] = p;
  }
  copies.shape.mesh = std::move(arrays).finish();
}

void change_normals(const std::vector<std::vector<double>>& weights, std::size_t targets,
                    Copies& copies) {
  const auto layers = target_layers(copies.shape.attributes, targets, "NORMAL");
  const std::uint32_t vertices = copies.shape.mesh.vertex_count();
  for (AttributeLayer& normals : copies.shape.attributes.layers) {
    if (normals.type().kind != AttributeKind::normal) continue;
    for (std::uint32_t w = 0; w < normals.count(); ++w) {
      const Vertex v = copies.shape.attributes.vertex(Wedge(w), vertices);
      const std::uint32_t copy = copies.of_vertex[v.index()];
      if (copy == kNone || is_absent(normals, w)) continue;
      const AttributeValue before = load(normals, w);
      const glm::dvec3 n =
          glm::dvec3(before[0], before[1], before[2]) + change_of(layers, weights[copy], w);
      const double length = glm::length(n);
      if (length > 0.0) store(normals, w, {n.x / length, n.y / length, n.z / length, 0.0});
    }
  }
}

}  // namespace

void add_targets(const std::vector<std::vector<double>>& weights, Copies& copies) {
  std::size_t targets = 0;
  for (const std::vector<double>& own : weights) {
    const bool has_any = std::ranges::any_of(own, [](double weight) { return weight != 0.0; });
    if (has_any) targets = std::max(targets, own.size());
  }
  if (targets == 0) return;
  change_positions(weights, targets, copies);
  change_normals(weights, targets, copies);
}

}  // namespace mesher::scene
