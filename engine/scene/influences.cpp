#include "engine/scene/influences.h"

#include <span>
#include <vector>

#include "engine/mesh/joints.h"

namespace mesher::scene {
namespace {

/// Makes the sum of the weights 1.
void normalize(std::span<Influence> influences) {
  double sum = 0.0;
  for (const Influence& influence : influences)
    sum += double(influence.weight);
  if (!(sum > 0.0)) {
    influences.front() = {0, 1.0F};
    return;
  }
  for (Influence& influence : influences)
    influence.weight = static_cast<float>(double(influence.weight) / sum);
}

}  // namespace

Influences influences_of(const Shape& shape) {
  const std::span<const AttributeLayer> layers = shape.attributes.layers;
  const std::vector<JointSet> sets = joint_sets(layers);
  Influences result;
  for (const JointSet& set : sets)
    result.per_vertex += layers[set.joints].type().components;
  if (sets.empty()) return result;
  result.list.assign(std::size_t{shape.mesh.vertex_count()} * result.per_vertex, Influence());
  for (std::uint32_t v = 0; v < shape.mesh.vertex_count(); ++v) {
    const std::span<Influence> own =
        std::span(result.list).subspan(std::size_t{v} * result.per_vertex, result.per_vertex);
    std::size_t count = 0;
    for_each_joint(layers, sets, v, [&](std::uint32_t joint, double weight) {
      own[count++] = {joint, static_cast<float>(weight)};
    });
    normalize(own);
  }
  return result;
}

}  // namespace mesher::scene
