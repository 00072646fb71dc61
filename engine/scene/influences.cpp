#include "engine/scene/influences.h"

#include <cmath>
#include <string>
#include <utility>

namespace mesher::scene {
namespace {

constexpr std::uint32_t kPerLayer = 4;
constexpr double kMost = 1U << 24U;  ///< joints

using LayerPair = std::pair<const AttributeLayer*, const AttributeLayer*>;

std::vector<LayerPair> joint_layers(const Attributes& attributes) {
  std::vector<LayerPair> pairs;
  for (;;) {
    const std::string set = std::to_string(pairs.size());
    const LayerPair pair{attributes.find("JOINTS_" + set), attributes.find("WEIGHTS_" + set)};
    if (pair.first == nullptr || pair.second == nullptr) return pairs;
    pairs.push_back(pair);
  }
}

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
  const std::vector<LayerPair> layers = joint_layers(shape.attributes);
  Influences result{.per_vertex = kPerLayer * static_cast<std::uint32_t>(layers.size())};
  if (layers.empty()) return result;
  result.list.assign(std::size_t{shape.mesh.vertex_count()} * result.per_vertex, Influence());
  for (std::uint32_t v = 0; v < shape.mesh.vertex_count(); ++v) {
    const std::span<Influence> own =
        std::span(result.list).subspan(std::size_t{v} * result.per_vertex, result.per_vertex);
    for (std::size_t set = 0; set < layers.size(); ++set) {
      const AttributeValue joint = load(*layers[set].first, v);
      const AttributeValue weight = load(*layers[set].second, v);
      for (std::size_t i = 0; i < kPerLayer; ++i) {
        // Written so that NaN is refused too.
        if (!(weight[i] > 0.0 && std::isfinite(weight[i]) && joint[i] >= 0.0 && joint[i] < kMost))
          continue;
        own[kPerLayer * set + i] = {static_cast<std::uint32_t>(joint[i]),
                                    static_cast<float>(weight[i])};
      }
    }
    normalize(own);
  }
  return result;
}

}  // namespace mesher::scene
