#include "engine/progressive/merged_value.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace mesher::progressive {
namespace {

// As in simplification, a face thinner than this share of its longest side counts as that thick:
// the gradient over a sliver is noise.
constexpr double kThinnestFace = 0.01;

/// A sum of values, weighted by area.
struct WeightedSum {
  AttributeValue value{};
  double area = 0.0;

  WeightedSum& operator+=(const WeightedSum& by) {
    for (std::size_t k = 0; k < value.size(); ++k)
      value[k] += by.value[k];
    area += by.area;
    return *this;
  }
};

WeightedSum sum_of(const AttributeLayer& layer, const MergedSide& side) {
  WeightedSum sum;
  for (const FaceShare& share : side.shares) {
    const AttributeValue first = load(layer, share.wedges[0].index());
    const AttributeValue second = load(layer, share.wedges[1].index());
    const AttributeValue third = load(layer, share.wedges[2].index());
    for (std::size_t k = 0; k < first.size(); ++k) {
      sum.value[k] += share.area * (first[k] + share.second * (second[k] - first[k]) +
                                    share.third * (third[k] - first[k]));
    }
    sum.area += share.area;
  }
  return sum;
}

bool is_blended(const AttributeLayer& layer, const MergedSide& side) {
  const AttributeKind kind = layer.type().kind;
  if (kind == AttributeKind::joints || kind == AttributeKind::weights) return false;
  if (!can_blend(layer.type())) return false;
  return std::ranges::none_of(side.shares, [&](const FaceShare& share) {
    return std::ranges::any_of(share.wedges, [&](Wedge w) { return is_absent(layer, w.index()); });
  });
}

bool is_same(const AttributeLayer& layer, Wedge a, Wedge b) {
  return std::ranges::equal(layer.value(a.index()), layer.value(b.index()));
}

bool agree(const AttributeLayer& layer, const MergedSide& a, const MergedSide& b) {
  return is_same(layer, a.at_child, b.at_child) && is_same(layer, a.at_parent, b.at_parent);
}

/// Restores what linear blending breaks.
void repair(const AttributeLayer& layer, Wedge nearer, AttributeValue& value) {
  const AttributeKind kind = layer.type().kind;
  if (kind == AttributeKind::color) {
    for (double& x : value)
      x = std::clamp(x, 0.0, 1.0);
  }
  if (kind != AttributeKind::normal && kind != AttributeKind::tangent) return;
  const AttributeValue at_end = load(layer, nearer.index());
  const double length = glm::length(glm::dvec3(value[0], value[1], value[2]));
  for (std::size_t k = 0; k < 3; ++k)
    value[k] = length > 0.0 ? value[k] / length : at_end[k];
  value[3] = at_end[3];
}

}  // namespace

FaceShare face_share(const std::array<glm::dvec3, 3>& corners, const std::array<Wedge, 3>& wedges,
                     const glm::dvec3& p) {
  const glm::dvec3 second = corners[1] - corners[0];
  const glm::dvec3 third = corners[2] - corners[0];
  const glm::dvec3 between = corners[2] - corners[1];
  const glm::dvec3 normal = glm::cross(second, third);
  const double area2 = glm::dot(normal, normal);
  const double longest2 =
      std::max({glm::dot(second, second), glm::dot(third, third), glm::dot(between, between)});
  const double least = kThinnestFace * longest2;
  const double divisor = std::max(area2, least * least);
  FaceShare share{.area = std::sqrt(area2), .wedges = wedges};
  if (!(divisor > 0.0)) return share;
  const glm::dvec3 offset = p - corners[0];
  share.second = glm::dot(glm::cross(third, normal), offset) / divisor;
  share.third = glm::dot(glm::cross(normal, second), offset) / divisor;
  return share;
}

void store_merged(const AttributeLayer& from, const MergedSide& side, const MergedSide* across,
                  AttributeLayer& to, std::size_t i) {
  const auto keep_nearer = [&] {
    std::ranges::copy(from.value(side.nearer.index()), to.value(i).begin());
  };
  if (!is_blended(from, side)) return keep_nearer();
  WeightedSum sum = sum_of(from, side);
  if (across != nullptr && is_blended(from, *across) && agree(from, side, *across)) {
    sum += sum_of(from, *across);
  }
  if (!(sum.area > 0.0)) return keep_nearer();
  for (double& x : sum.value)
    x /= sum.area;
  repair(from, side.nearer, sum.value);
  store(to, i, sum.value);
}

}  // namespace mesher::progressive
