#include "engine/analysis/surface_samples.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/analysis/surface_point.h"

namespace mesher::analysis {
namespace {

double area(const Mesh& mesh, Face face) {
  const auto [a, b, c] = corners_of(mesh, face);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

double fraction(double x) {
  return x - std::floor(x);
}

}  // namespace

SurfaceSamples::SurfaceSamples(const Mesh& mesh, std::uint64_t count)
    : mesh_(mesh), area_before_(std::size_t{mesh.face_count()} + 1, 0.0) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    area_before_[f + 1] = area_before_[f] + area(mesh, Face(f));
  const double total = area_before_.back();
  per_area_ = total > 0.0 ? static_cast<double>(count) / total : 0.0;
}

// A sequence that fills a triangle evenly (M. Roberts, "The unreasonable effectiveness of
// quasirandom sequences", 2018: powers of the plastic number).
glm::dvec3 SurfaceSamples::weights(std::uint64_t sample) {
  const double u = std::sqrt(fraction(0.5 + 0.7548776662466927 * static_cast<double>(sample)));
  const double v = fraction(0.5 + 0.5698402909980532 * static_cast<double>(sample));
  return {1.0 - u, u * (1.0 - v), u * v};
}

glm::dvec3 SurfaceSamples::position(std::size_t face, std::uint64_t sample) const {
  const auto [a, b, c] = corners_of(mesh_, Face(static_cast<std::uint32_t>(face)));
  const glm::dvec3 w = weights(sample);
  return w.x * a + w.y * b + w.z * c;
}

}  // namespace mesher::analysis
