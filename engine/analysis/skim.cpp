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
/// Faces are split only if more than this multiple of the rounding is allowed.
constexpr double kLeastForParts = 16.0;
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

std::array<Triangle, 4> quarters(const Triangle& t) {
  const std::array<glm::dvec3, 3> middle{0.5 * (t[1] + t[2]), 0.5 * (t[2] + t[0]),
                                         0.5 * (t[0] + t[1])};
  return {{{t[0], middle[2], middle[1]},
           {middle[2], t[1], middle[0]},
           {middle[1], middle[0], t[2]},
           {middle[0], middle[1], middle[2]}}};
}

/// The parts of a face that are not settled.
class Parts {
 public:
  struct Part {
    Triangle corners;
    double upper = kUnbounded;
  };

  /// Starts with a whole face and an upper bound for it.
  void begin(const Triangle& face, double upper) {
    parts_.assign(1, {face, upper});
    is_whole_ = true;
    upper_ = 0.0;
  }

  /// Splits the parts again and again. If the other surface is folded or flipped along a line, this
  /// settles the parts off that line.
  void split(const Mesh& to, Face hint, double allowed, OverlayWalk& walk) {
    for (int level = 0; level < kDepth && parts_.size() <= kMostParts; ++level) {
      next_.clear();
      const std::size_t splits = split_once(to, hint, allowed, walk);
      const bool is_in_vain = is_whole_ && next_.size() == kQuarters;
      if (splits == 0 || is_in_vain) return;
      is_whole_ = false;
      std::swap(parts_, next_);
    }
  }

  std::span<const Part> parts() const { return parts_; }
  bool is_whole() const { return is_whole_; }
  /// Returns the upper bound for the settled parts.
  double upper() const { return upper_; }

 private:
  static constexpr int kDepth = 6;
  static constexpr std::size_t kMostParts = 48;
  static constexpr std::size_t kQuarters = 4;
  /// Parts smaller than this, relative to the allowed distance, are left to the branch and bound.
  static constexpr double kLeastRadius = 3.0;

  /// Writes the parts that are left to `next_`. Returns how many were split.
  std::size_t split_once(const Mesh& to, Face hint, double allowed, OverlayWalk& walk) {
    std::size_t splits = 0;
    for (const Part& part : parts_) {
      if (Ball(part.corners).radius < kLeastRadius * allowed) {
        next_.push_back(part);
        continue;
      }
      ++splits;
      for (const Triangle& quarter : quarters(part.corners)) {
        const double upper = std::min(part.upper, bound(quarter, to, hint, allowed, walk));
        if (upper > allowed) {
          next_.push_back({quarter, upper});
        } else {
          upper_ = std::max(upper_, upper);
        }
      }
    }
    return splits;
  }

  std::vector<Part> parts_;
  std::vector<Part> next_;
  bool is_whole_ = true;
  double upper_ = 0.0;
};

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
    Parts left;
    Skimmed& part = parts[chunk];
    const auto certified = [&](double computed) {
      return computed > 0.0 ? computed * (1.0 + 1e-12) + input.rounding : 0.0;
    };
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Face f = input.only ? (*input.only)[i] : Face(static_cast<std::uint32_t>(i));
      const Triangle t = triangle(from, f);
      const Face hint = input.hints[f.index()];
      double upper = kUnbounded;
      if (is_near(f)) upper = certified(input.near + reach(squared_sides(t)));
      if (upper > allowed) {
        upper = std::min(upper, certified(bound(t, input.to, hint, allowed, walk)));
      }
      if (upper <= allowed) {
        part.upper = std::max(part.upper, upper);
        continue;
      }
      left.begin(t, upper);
      // The corners of parts are rounded.
      if (allowed > kLeastForParts * input.rounding) left.split(input.to, hint, allowed, walk);
      part.upper = std::max(part.upper, certified(left.upper()));
      for (const auto& [corners, most] : left.parts())
        part.unclear.push_back({.face = f,
                                .upper = certified(most),
                                .part = left.is_whole() ? std::nullopt : std::optional(corners)});
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
