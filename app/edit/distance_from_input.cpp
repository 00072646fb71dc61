#include "app/edit/distance_from_input.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/analysis/triangle_tree.h"
#include "engine/simplify/options.h"

namespace mesher::app {
namespace {

constexpr std::uint32_t kPoints = 4096;

}  // namespace

double distance_from_input(const Mesh& input, const Mesh& result) {
  if (input.face_count() == 0 || result.face_count() == 0) return 0.0;
  const analysis::TriangleTree tree(result);
  // Rounded up, so that there are at most kPoints points.
  const std::uint32_t stride = (input.face_count() + kPoints - 1) / kPoints;
  double sum = 0.0;
  double area_sum = 0.0;
  Face hint(0);
  for (std::uint32_t f = 0; f < input.face_count(); f += stride) {
    const auto corner = [&](std::uint32_t c) {
      return glm::dvec3(input.position(input.origin(Mesh::halfedge(Face(f), c))));
    };
    const glm::dvec3 a = corner(0);
    const glm::dvec3 b = corner(1);
    const glm::dvec3 c = corner(2);
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    const analysis::TriangleTree::Nearest nearest = tree.nearest((a + b + c) / 3.0, hint);
    hint = nearest.face;
    sum += area * nearest.squared_distance;
    area_sum += area;
  }
  return area_sum > 0.0 ? std::sqrt(sum / area_sum) : 0.0;
}

std::optional<double> far_percent(const Mesh& input, const Mesh& result, double diagonal) {
  if (result.face_count() > kManyFaces) return std::nullopt;
  const double distance = distance_from_input(input, result);
  if (!(distance > simplify::kFarFromInput * diagonal)) return std::nullopt;
  return 100.0 * distance / diagonal;
}

}  // namespace mesher::app
