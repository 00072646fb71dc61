#include "engine/mesh/joints.h"

#include <algorithm>
#include <limits>
#include <string>

namespace mesher {
namespace {

/// Returns the smallest difference of two weights, or 0 if weights are floats.
double weight_step(const AttributeType& type) {
  switch (type.component) {
    case ComponentType::u8:
      return 1.0 / std::numeric_limits<std::uint8_t>::max();
    case ComponentType::u16:
      return 1.0 / std::numeric_limits<std::uint16_t>::max();
    case ComponentType::s8:
      return 1.0 / std::numeric_limits<std::int8_t>::max();
    case ComponentType::s16:
      return 1.0 / std::numeric_limits<std::int16_t>::max();
    case ComponentType::u32:
    case ComponentType::f32:
      break;
  }
  return 0.0;
}

/// Rounds weights one after the other so that their sum is as exact as one of them.
class WeightRounding {
 public:
  double operator()(double weight, double step) {
    if (!(step > 0.0)) return weight;
    exact_ += weight;
    const double rounded = std::round(exact_ / step) * step - given_;
    given_ += rounded;
    return rounded;
  }

 private:
  double exact_ = 0.0;
  double given_ = 0.0;
};

}  // namespace

std::vector<JointSet> joint_sets(std::span<const AttributeLayer> layers) {
  const auto find = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::ranges::find_if(layers, [&](const auto& layer) { return layer.type().name == name; }) -
        layers.begin());
  };
  std::vector<JointSet> sets;
  for (;;) {
    const std::string number = std::to_string(sets.size());
    const JointSet set{find("JOINTS_" + number), find("WEIGHTS_" + number)};
    if (std::max(set.joints, set.weights) == layers.size() ||
        layers[set.joints].type().components != layers[set.weights].type().components) {
      return sets;
    }
    sets.push_back(set);
  }
}

void JointSum::add(std::span<const AttributeLayer> layers, std::span<const JointSet> sets,
                   std::size_t i, double factor) {
  for_each_joint(layers, sets, i, [&](std::uint32_t joint, double weight) {
    const auto same = std::ranges::find(sum_, joint, &Share::joint);
    if (same != sum_.end()) {
      same->weight += factor * weight;
    } else {
      sum_.push_back({joint, factor * weight});
    }
  });
}

bool JointSum::store(std::span<AttributeLayer> layers, std::span<const JointSet> sets,
                     std::size_t i) {
  if (sum_.empty()) return false;
  std::ranges::sort(sum_, [](const Share& a, const Share& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.joint < b.joint;
  });
  std::size_t room = 0;
  for (const JointSet& set : sets)
    room += layers[set.joints].type().components;
  const std::size_t count = std::min(room, sum_.size());
  double all = 0.0;
  double kept = 0.0;
  for (std::size_t k = 0; k < sum_.size(); ++k) {
    all += sum_[k].weight;
    if (k < count) kept += sum_[k].weight;
  }
  WeightRounding rounded;
  std::size_t k = 0;
  for (const JointSet& set : sets) {
    AttributeValue joints{};
    AttributeValue weights{};
    const double step = weight_step(layers[set.weights].type());
    for (std::size_t c = 0; c < layers[set.joints].type().components && k < count; ++c, ++k) {
      weights[c] = rounded(sum_[k].weight * (all / kept), step);
      // An unused place names joint 0, as files must.
      if (weights[c] > 0.0) joints[c] = sum_[k].joint;
    }
    mesher::store(layers[set.joints], i, joints);
    mesher::store(layers[set.weights], i, weights);
  }
  return true;
}

}  // namespace mesher
