#include "engine/analysis/skim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/analysis/overlay_walk.h"
#include "engine/analysis/triangle_tree.h"
#include "engine/core/parallel.h"

namespace mesher {
namespace {

constexpr std::size_t kFacesPerChunk = 4096;

using Triangle = std::array<glm::dvec3, 3>;

Triangle triangle(const Mesh& mesh, Face f) {
  return {mesh.position(mesh.origin(Mesh::halfedge(f, 0))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 1))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 2)))};
}

/// The middle of a triangle, and how far from it its points are at most.
struct Ball {
  explicit Ball(const Triangle& t) : middle((t[0] + t[1] + t[2]) / 3.0) {
    double squared = 0.0;
    for (const glm::dvec3& p : t)
      squared = std::max(squared, glm::dot(p - middle, p - middle));
    radius = std::sqrt(squared);
  }

  glm::dvec3 middle;
  double radius = 0.0;
};

/// A bound for one face.
double bound(const Triangle& t, const Mesh& to, Face hint, double allowed, OverlayWalk& walk) {
  // What a face only touches need not be walked over: it is cut off, and its width counts.
  constexpr double kPartForShrinking = 0.2;
  constexpr double kMostShrink = 0.1;
  const Triangle near = triangle(to, hint);
  if (near == t) return 0.0;
  const Ball ball(t);
  double least = std::numeric_limits<double>::infinity();
  if (ball.radius < allowed) {
    least = std::sqrt(squared_distance(ball.middle, near)) + ball.radius;
    if (least <= allowed) return least;
  }
  const double shrink = std::min(kMostShrink, kPartForShrinking * allowed / ball.radius);
  const double height = walk.locate(t, hint, shrink);
  least = std::min(least, height + ball.radius);
  if (least <= allowed || !std::isfinite(height)) return least;
  const double width = shrink * ball.radius;
  return std::min(least, walk.bound(allowed - width) + width);
}

}  // namespace

Skimmed skim(const Mesh& from, const Mesh& to, std::span<const Face> hints, double allowed,
             double rounding, Progress* progress) {
  const std::size_t n = from.face_count();
  std::vector<Skimmed> parts(chunk_count(n, kFacesPerChunk));
  parallel_chunks(n, kFacesPerChunk, progress, [&](std::size_t chunk, IndexRange range) {
    OverlayWalk walk(to);
    Skimmed& part = parts[chunk];
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Face f(static_cast<std::uint32_t>(i));
      const double computed = bound(triangle(from, f), to, hints[i], allowed, walk);
      const double upper = computed > 0.0 ? computed * (1.0 + 1e-12) + rounding : 0.0;
      if (upper <= allowed) {
        part.upper = std::max(part.upper, upper);
      } else {
        part.unclear.push_back({f, upper});
      }
    }
  });
  Skimmed all;
  for (const Skimmed& part : parts) {
    all.upper = std::max(all.upper, part.upper);
    all.unclear.insert(all.unclear.end(), part.unclear.begin(), part.unclear.end());
  }
  return all;
}

}  // namespace mesher
