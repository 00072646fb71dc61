#include "app/document/automatic_level.h"

#include <algorithm>
#include <limits>

namespace mesher::app {
namespace {

// A coarser level is chosen only if its error is below this share of the tolerance.
constexpr double kCoarserBelow = 0.8;
// The minimum distance, as a share of the diagonal.
constexpr double kNearest = 0.05;

}  // namespace

std::uint32_t automatic_level(const progressive::LevelErrors& errors, std::uint32_t level,
                              double tolerance, double pixels_per_unit) {
  const double allowed = tolerance / pixels_per_unit;
  const std::uint32_t finer = errors.level_within(allowed);
  if (finer >= level) return finer;
  return std::min(level, errors.level_within(kCoarserBelow * allowed));
}

double pixels_per_unit(const render::Camera& camera, const Box& box, const glm::dvec2& window) {
  const render::WindowProjection places = camera.places(window);
  if (!places.perspective) return places.scale;
  double depth = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    depth = std::min(depth, places.depth({(corner & 1) != 0 ? box.max.x : box.min.x,
                                          (corner & 2) != 0 ? box.max.y : box.min.y,
                                          (corner & 4) != 0 ? box.max.z : box.min.z}));
  }
  return places.scale / std::max({depth, kNearest * box.diagonal(), 1e-30});
}

}  // namespace mesher::app
