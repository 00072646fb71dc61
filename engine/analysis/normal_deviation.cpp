#include "engine/analysis/normal_deviation.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "engine/analysis/sample_values.h"
#include "engine/mesh/unit_vector.h"

namespace mesher::analysis {
namespace {}  // namespace

ShadingNormals::ShadingNormals(const AttributedSurface& surface)
    : surface_(surface), layer_(surface.attributes.find(normal_type().name)) {
  if (layer_ != nullptr && layer_->type().components < 3) layer_ = nullptr;
}

glm::dvec3 ShadingNormals::at(const SurfacePoint& point) const {
  if (layer_ != nullptr) {
    const AttributeValue value = SurfaceLayer(surface_, *layer_).at(point);
    const glm::dvec3 normal = unit_or_zero({value[0], value[1], value[2]});
    if (normal != glm::dvec3(0.0)) return normal;
  }
  const auto [a, b, c] = corners_of(surface_.mesh, point.face);
  return unit_or_zero(glm::cross(b - a, c - a));
}

Spread normal_deviation(const AttributedSurface& from, const AttributedSurface& to,
                        const SurfaceMatches& matches) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const ShadingNormals here(from);
  const ShadingNormals there(to);
  return Spread(values_at_samples(matches.count(), [&](std::size_t i) {
    const glm::dvec3 normal = here.at(matches.sample(i));
    if (normal == glm::dvec3(0.0)) return kNone;
    return least_difference(matches, i, [&](const SurfacePoint& candidate) {
      const glm::dvec3 other = there.at(candidate);
      if (other == glm::dvec3(0.0)) return kNone;
      // Exact for small angles, unlike the arc cosine.
      return glm::degrees(
          std::atan2(glm::length(glm::cross(normal, other)), glm::dot(normal, other)));
    });
  }));
}

}  // namespace mesher::analysis
