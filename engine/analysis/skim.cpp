#include "engine/analysis/skim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/analysis/overlay_walk.h"
#include "engine/analysis/triangle_reach.h"
#include "engine/analysis/triangle_tree.h"
#include "engine/core/parallel.h"

namespace mesher::analysis {
namespace {

constexpr std::size_t kSkimmedFacesPerChunk = 4096;
constexpr int kDepth = 3;
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

Triangle triangle(const Mesh& mesh, Face f) {
  return {mesh.position(mesh.origin(Mesh::halfedge(f, 0))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 1))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 2)))};
}

/// The bounding ball of a triangle about its middle.
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

/// Returns the largest distance of a triangle's corners from another one, which bounds the distance
/// of all its points, because the distance to a convex set is a convex function. Infinite if it is
/// more than `allowed`.
double farthest_corner(const Triangle& t, const Triangle& other, double allowed) {
  double most = 0.0;
  for (const glm::dvec3& p : t) {
    most = std::max(most, squared_distance(p, other));
    if (most > allowed * allowed) return kUnbounded;
  }
  return std::sqrt(most);
}

/// Returns an upper bound for one face.
double bound(const Triangle& t, const Mesh& to, Face hint, double allowed, OverlayWalk& walk) {
  // Shrinking the triangle avoids the faces that it only touches. The border that is cut off adds
  // its width to the bound, so a narrower border leaves more for the rest.
  constexpr std::array<double, 2> kPartForShrinking{0.2, 0.04};
  constexpr double kMostShrink = 0.1;
  const Triangle near = triangle(to, hint);
  if (near == t) return 0.0;
  const Ball ball(t);
  double least = kUnbounded;
  if (ball.radius < allowed) {
    least = std::sqrt(squared_distance(ball.middle, near)) + ball.radius;
    if (least <= allowed) return least;
  }
  least = std::min(least, farthest_corner(t, near, allowed));
  if (least <= allowed) return least;
  for (const double part : kPartForShrinking) {
    const double shrink = std::min(kMostShrink, part * allowed / ball.radius);
    const double height = walk.locate(t, hint, shrink);
    least = std::min(least, height + ball.radius);
    if (least <= allowed || !std::isfinite(height)) return least;
    if (const Face below = walk.located(); below != hint) {
      least = std::min(least, farthest_corner(t, triangle(to, below), allowed));
      if (least <= allowed) return least;
    }
    const double width = shrink * ball.radius;
    least = std::min(least, walk.bound(allowed - width) + width);
    if (least <= allowed) return least;
  }
  return least;
}

/// The same, but splits the face if the bound is too large. If the surface is folded or flipped
/// somewhere, most parts avoid that spot, and the others are small.
double bound_by_parts(const Triangle& t, const Mesh& to, Face hint, double allowed,
                      OverlayWalk& walk, int depth) {
  const double whole = bound(t, to, hint, allowed, walk);
  if (whole <= allowed || depth == 0) return whole;
  const std::array<glm::dvec3, 3> middle{0.5 * (t[1] + t[2]), 0.5 * (t[2] + t[0]),
                                         0.5 * (t[0] + t[1])};
  const std::array<Triangle, 4> parts{{{t[0], middle[2], middle[1]},
                                       {middle[2], t[1], middle[0]},
                                       {middle[1], middle[0], t[2]},
                                       {middle[0], middle[1], middle[2]}}};
  double most = 0.0;
  for (const Triangle& part : parts) {
    most = std::max(most, bound_by_parts(part, to, hint, allowed, walk, depth - 1));
    if (most > allowed) return whole;
  }
  return most;
}

}  // namespace

Skimmed skim(const SkimInput& input, double allowed, Progress* progress) {
  const Mesh& from = input.from;
  const std::size_t n = input.only ? input.only->size() : from.face_count();
  const auto is_near = [&](Face f) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      if (input.is_near[from.origin(Mesh::halfedge(f, c)).index()] == 0) return false;
    }
    return true;
  };
  std::vector<Skimmed> parts(chunk_count(n, kSkimmedFacesPerChunk));
  parallel_chunks(n, kSkimmedFacesPerChunk, progress, [&](std::size_t chunk, IndexRange range) {
    OverlayWalk walk(input.to);
    Skimmed& part = parts[chunk];
    const auto certified = [&](double computed) {
      return computed > 0.0 ? computed * (1.0 + 1e-12) + input.rounding : 0.0;
    };
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Face f = input.only ? (*input.only)[i] : Face(static_cast<std::uint32_t>(i));
      const Triangle t = triangle(from, f);
      double upper = kUnbounded;
      if (is_near(f)) upper = certified(input.near + reach(squared_sides(t)));
      if (upper > allowed) {
        upper = std::min(upper, certified(bound_by_parts(t, input.to, input.hints[f.index()],
                                                         allowed, walk, kDepth)));
      }
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

}  // namespace mesher::analysis
