#include "engine/subdivide/masks.h"

#include <cmath>
#include <numbers>

#include "engine/core/assert.h"

namespace mesher::subdivide {
namespace {

double loop_own_weight(std::uint32_t valence) {
  const double root = 3.0 / 8.0 + std::cos(2.0 * std::numbers::pi / valence) / 4.0;
  return 3.0 / 8.0 + root * root;
}

RingMask ring_mask(double own, std::uint32_t valence) {
  return {own, (1.0 - own) / valence};
}

[[maybe_unused]] bool is_crease(VertexKind kind) {
  return kind == VertexKind::crease || kind == VertexKind::regular_crease;
}

}  // namespace

RingMask loop_vertex_mask(std::uint32_t valence) {
  return ring_mask(loop_own_weight(valence), valence);
}

RingMask loop_limit_mask(std::uint32_t valence) {
  return ring_mask(3.0 / (11.0 - 8.0 * loop_own_weight(valence)), valence);
}

RingMask crease_limit_mask(CreaseRules rules, VertexKind kind) {
  MESHER_ASSERT(is_crease(kind));
  if (rules == CreaseRules::hoppe94 && kind == VertexKind::crease) return {3.0 / 5.0, 1.0 / 5.0};
  return {2.0 / 3.0, 1.0 / 6.0};
}

bool has_sharp_mask(CreaseRules rules, VertexKind first, VertexKind second) {
  return rules == CreaseRules::derose98 ||
         (first != VertexKind::dart && second != VertexKind::dart);
}

double sharp_edge_weight(CreaseRules rules, VertexKind first, VertexKind second) {
  const bool first_is_regular = first == VertexKind::regular_crease;
  const bool second_is_regular = second == VertexKind::regular_crease;
  if (rules == CreaseRules::derose98 || first_is_regular == second_is_regular) return 1.0 / 2.0;
  return first_is_regular ? 5.0 / 8.0 : 3.0 / 8.0;
}

double across_crease_tangent(CreaseRules rules, VertexKind kind, std::span<double> neighbors) {
  const std::size_t n = neighbors.size();
  MESHER_ASSERT(n >= 2 && is_crease(kind));
  if (n == 2) {
    neighbors[0] = neighbors[1] = 1.0;
    return -2.0;
  }
  if (n == 3) {
    neighbors[0] = neighbors[2] = 0.0;
    neighbors[1] = 1.0;
    return -1.0;
  }
  const bool has_halves = rules == CreaseRules::derose98 || kind == VertexKind::regular_crease;
  const double angle = std::numbers::pi / static_cast<double>(n - 1);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double inner = has_halves ? (1.0 + 1.0 / c - 2.0 * c) / s : 2.0 - 2.0 * c;
  for (std::size_t i = 0; i < n; ++i)
    neighbors[i] = inner * std::sin(static_cast<double>(i) * angle);
  neighbors[0] = neighbors[n - 1] = has_halves ? -1.0 : -s;
  return has_halves ? -1.0 / c : 0.0;
}

double butterfly_ring_weight(std::uint32_t valence, std::uint32_t i) {
  MESHER_ASSERT(valence >= 3 && i < valence);
  if (valence == 3) return i == 0 ? 5.0 / 12.0 : -1.0 / 12.0;
  if (valence == 4) return i == 0 ? 3.0 / 8.0 : (i == 2 ? -1.0 / 8.0 : 0.0);
  const double angle = 2.0 * std::numbers::pi * i / valence;
  return (0.25 + std::cos(angle) + 0.5 * std::cos(2.0 * angle)) / valence;
}

}  // namespace mesher::subdivide
