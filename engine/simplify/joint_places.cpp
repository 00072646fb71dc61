#include "engine/simplify/joint_places.h"

#include <span>
#include <unordered_map>

#include "engine/mesh/joints.h"

namespace mesher::simplify {
namespace {

/// A mean of points by weight.
struct WeightedMean {
  glm::dvec3 sum{0.0};
  double weight = 0.0;

  void add(const glm::dvec3& p, double w) {
    sum += w * p;
    weight += w;
  }
  glm::dvec3 mean() const { return weight > 0.0 ? sum / weight : glm::dvec3(0.0); }
};

}  // namespace

std::vector<glm::dvec3> joint_places(const Mesh& mesh, const Attributes& attributes) {
  const std::span<const AttributeLayer> layers = attributes.layers;
  const std::vector<JointSet> sets = joint_sets(layers);
  if (sets.empty()) return {};
  const auto wedges = static_cast<std::uint32_t>(layers.front().count());
  std::unordered_map<std::uint32_t, WeightedMean> places;
  WeightedMean middle;
  for (std::uint32_t w = 0; w < wedges; ++w) {
    const glm::dvec3 p(mesh.position(attributes.vertex(Wedge(w), mesh.vertex_count())));
    for_each_joint(layers, sets, w, [&](std::uint32_t joint, double weight) {
      places[joint].add(p, weight);
      middle.add(p, weight);
    });
  }
  std::vector<glm::dvec3> result(wedges);
  for (std::uint32_t w = 0; w < wedges; ++w) {
    WeightedMean of_joints;
    for_each_joint(layers, sets, w, [&](std::uint32_t joint, double weight) {
      of_joints.add(places.at(joint).mean() - middle.mean(), weight);
    });
    result[w] = of_joints.mean();
  }
  return result;
}

}  // namespace mesher::simplify
