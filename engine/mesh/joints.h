#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/attributes.h"

namespace mesher {

/// The layers JOINTS_n and WEIGHTS_n of one n. They bind points to joints (bones) of a skin: a
/// value of the first names the joints, the same value of the second says how much each of them
/// counts.
struct JointSet {
  std::size_t joints;   ///< index of its layer
  std::size_t weights;  ///< same
};

/// Returns the sets 0, 1, 2 and so on, as far as both of their layers are there and have as many
/// components.
std::vector<JointSet> joint_sets(std::span<const AttributeLayer> layers);

/// Calls `visit(joint, weight)` for the joints of value i. Weights that are not above 0 do not
/// count, nor do indices that no file can have.
template <class Visit>
void for_each_joint(std::span<const AttributeLayer> layers, std::span<const JointSet> sets,
                    std::size_t i, const Visit& visit) {
  constexpr double kMostJoints = 1U << 24U;
  for (const JointSet& set : sets) {
    const AttributeValue joint = load(layers[set.joints], i);
    const AttributeValue weight = load(layers[set.weights], i);
    for (std::size_t c = 0; c < layers[set.joints].type().components; ++c) {
      // Written so that NaN is refused too.
      if (!(weight[c] > 0.0 && std::isfinite(weight[c]) && joint[c] >= 0.0 &&
            joint[c] < kMostJoints)) {
        continue;
      }
      visit(static_cast<std::uint32_t>(joint[c]), weight[c]);
    }
  }
}

/// A weighted sum of the joints of several points.
class JointSum {
 public:
  void clear() { sum_.clear(); }
  /// Adds the joints of value i, their weights multiplied by a factor above 0. O(joints).
  void add(std::span<const AttributeLayer> layers, std::span<const JointSet> sets, std::size_t i,
           double factor);
  /// Sets value i to the joints with the largest weights, as many as the sets have room for. Their
  /// weights are scaled so that the sum of all stays; integers are rounded so that it does, too.
  /// Returns false, and sets nothing, if there is no joint. O(joints log joints).
  bool store(std::span<AttributeLayer> layers, std::span<const JointSet> sets, std::size_t i);

 private:
  struct Share {
    std::uint32_t joint;
    double weight;
  };
  std::vector<Share> sum_;
};

}  // namespace mesher
