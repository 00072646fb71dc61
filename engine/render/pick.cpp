#include "engine/render/pick.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/core/parallel.h"

namespace mesher::render {
namespace {

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  Face face;
};

/// Distance along the ray, or infinity where it misses.
double intersect(const Mesh& mesh, Face f, const Ray& ray) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const auto corner = [&](std::uint32_t i) {
    return glm::dvec3(mesh.position(mesh.origin(Mesh::halfedge(f, i))));
  };
  const glm::dvec3 a = corner(0);
  const glm::dvec3 ab = corner(1) - a;
  const glm::dvec3 ac = corner(2) - a;
  const glm::dvec3 p = glm::cross(ray.direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return kMiss;
  const glm::dvec3 from_a = ray.origin - a;
  const double u = glm::dot(from_a, p) / determinant;
  if (!(u >= 0.0 && u <= 1.0)) return kMiss;
  const glm::dvec3 q = glm::cross(from_a, ab);
  const double v = glm::dot(ray.direction, q) / determinant;
  if (!(v >= 0.0 && u + v <= 1.0)) return kMiss;
  const double distance = glm::dot(ac, q) / determinant;
  return distance >= 0.0 ? distance : kMiss;
}

}  // namespace

std::optional<Hit> pick(const Mesh& mesh, const Ray& ray) {
  constexpr std::size_t kChunk = 1U << 16;
  std::vector<Nearest> nearest(chunk_count(mesh.face_count(), kChunk));
  parallel_chunks(mesh.face_count(), kChunk, [&](std::size_t chunk, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Face f(static_cast<std::uint32_t>(i));
      const double distance = intersect(mesh, f, ray);
      if (distance < nearest[chunk].distance) nearest[chunk] = {distance, f};
    }
  });
  const auto best =
      std::min_element(nearest.begin(), nearest.end(),
                       [](const Nearest& a, const Nearest& b) { return a.distance < b.distance; });
  if (best == nearest.end() || !best->face.is_valid()) return std::nullopt;
  return Hit{best->face, ray.origin + best->distance * ray.direction, best->distance};
}

}  // namespace mesher::render
