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

/// Returns the distance along the ray, or infinity if the ray misses.
double intersect(const Mesh& mesh, Face f, const Ray& ray) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  // Rounding must not let a ray pass between two faces.
  constexpr double kSeam = 1e-9;
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
  if (!(u >= -kSeam && u <= 1.0 + kSeam)) return kMiss;
  const glm::dvec3 q = glm::cross(from_a, ab);
  const double v = glm::dot(ray.direction, q) / determinant;
  if (!(v >= -kSeam && u + v <= 1.0 + kSeam)) return kMiss;
  const double distance = glm::dot(ac, q) / determinant;
  return distance >= 0.0 ? distance : kMiss;
}

/// Measures edges in a window, relative to the cursor.
class Screen {
 public:
  Screen(const Mesh& mesh, const Camera& camera, const Cursor& cursor)
      : mesh_(mesh),
        projection_(camera.places(cursor.window)),
        cursor_(cursor.position),
        near_(1e-3 * camera.distance()) {}

  /// Returns the distance from the cursor to an edge; infinite if the edge is not in front of the
  /// eye.
  double distance(Halfedge h) const {
    glm::dvec3 a = mesh_.position(mesh_.origin(h));
    glm::dvec3 b = mesh_.position(mesh_.target(h));
    if (projection_.perspective && !cut_behind_eye(a, b)) {
      return std::numeric_limits<double>::infinity();
    }
    const glm::dvec2 from = projection_.of(a);
    const glm::dvec2 along = projection_.of(b) - from;
    const glm::dvec2 to_cursor = cursor_ - from;
    const double square = glm::dot(along, along);
    const double share = square > 0.0 ? glm::dot(to_cursor, along) / square : 0.0;
    return glm::length(to_cursor - std::clamp(share, 0.0, 1.0) * along);
  }

 private:
  /// Clips the segment to the part in front of the near plane; false if none remains.
  bool cut_behind_eye(glm::dvec3& a, glm::dvec3& b) const {
    const double a_depth = projection_.depth(a) - near_;
    const double b_depth = projection_.depth(b) - near_;
    if (a_depth >= 0.0 && b_depth >= 0.0) return true;
    if (a_depth < 0.0 && b_depth < 0.0) return false;
    const glm::dvec3 cut = a + a_depth / (a_depth - b_depth) * (b - a);
    (a_depth < 0.0 ? a : b) = cut;
    return true;
  }

  const Mesh& mesh_;
  WindowProjection projection_;
  glm::dvec2 cursor_;
  double near_;
};

/// Returns the nearest of half-edges [begin, end); the first if two are equally near.
EdgeHit nearest_edge(const Mesh& mesh, const Screen& screen, IndexRange range) {
  EdgeHit nearest{{}, std::numeric_limits<double>::infinity()};
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const Edge e = mesh.edge(Halfedge(static_cast<std::uint32_t>(i)));
    const double distance = screen.distance(Mesh::halfedge(e));
    if (distance < nearest.distance_px) nearest = {e, distance};
  }
  return nearest;
}

EdgeHit nearest_of_all(const Mesh& mesh, const Screen& screen) {
  constexpr std::size_t kChunk = 1U << 16;
  std::vector<EdgeHit> parts(chunk_count(mesh.halfedge_count(), kChunk));
  parallel_chunks(mesh.halfedge_count(), kChunk, [&](std::size_t chunk, IndexRange range) {
    parts[chunk] = nearest_edge(mesh, screen, range);
  });
  const auto best = std::min_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.distance_px < b.distance_px;
  });
  return best == parts.end() ? EdgeHit{} : *best;
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

std::optional<EdgeHit> pick_edge(const Mesh& mesh, const Camera& camera, const Cursor& cursor,
                                 double tolerance_px) {
  const Screen screen(mesh, camera, cursor);
  const std::optional<Hit> hit = pick(mesh, camera.pick_ray(cursor));
  EdgeHit nearest;
  if (hit) {
    const std::size_t first = Mesh::halfedge(hit->face).index();
    nearest = nearest_edge(mesh, screen, {first, first + 3});
  } else {
    nearest = nearest_of_all(mesh, screen);
  }
  if (!nearest.edge.is_valid() || nearest.distance_px > tolerance_px) return std::nullopt;
  return nearest;
}

}  // namespace mesher::render
