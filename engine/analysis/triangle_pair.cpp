#include "engine/analysis/triangle_pair.h"

#include <cstddef>
#include <span>
#include <utility>

#include "engine/analysis/predicates.h"

namespace mesher::analysis {
namespace {

using Signs = std::array<int, 3>;

Signs sides(const ExactTriangle& plane, const ExactTriangle& points) {
  const auto& [a, b, c] = plane;
  return {orientation(a, b, c, points[0]), orientation(a, b, c, points[1]),
          orientation(a, b, c, points[2])};
}

bool is_one_sided(const Signs& s) {
  return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
}

bool is_zero(const Signs& s) {
  return s[0] == 0 && s[1] == 0 && s[2] == 0;
}

glm::dvec2 without(const glm::dvec3& p, int axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

int orientation_without(const ExactTriangle& t, int axis) {
  return orientation(without(t[0], axis), without(t[1], axis), without(t[2], axis));
}

/// Projects the plane of `t` onto a coordinate plane in which `t` has area.
class Projection {
 public:
  /// Pre: `t` is not degenerate.
  explicit Projection(const ExactTriangle& t) {
    while (axis_ < 2 && orientation_without(t, axis_) == 0)
      ++axis_;
  }

  glm::dvec2 operator()(const glm::dvec3& p) const { return without(p, axis_); }

  /// Returns whether all of `points` are strictly beyond one side of the triangle.
  template <std::size_t kPoints>
  bool is_beyond_side(const ExactTriangle& t, const std::array<glm::dvec3, kPoints>& points) const {
    const int inside = orientation_without(t, axis_);
    for (std::size_t i = 0; i < 3; ++i) {
      bool is_beyond = true;
      for (const glm::dvec3& p : points) {
        const int side = orientation((*this)(t[i]), (*this)(t[(i + 1) % 3]), (*this)(p));
        is_beyond = is_beyond && side == -inside;
      }
      if (is_beyond) return true;
    }
    return false;
  }

 private:
  int axis_ = 0;
};

/// Convex polygons are disjoint exactly if a side of one of them strictly separates them.
bool do_coplanar_intersect(const ExactTriangle& a, const ExactTriangle& b) {
  const Projection project(a);
  return !project.is_beyond_side(a, b) && !project.is_beyond_side(b, a);
}

bool do_coplanar_intersect(const std::array<glm::dvec3, 2>& segment, const ExactTriangle& t) {
  const Projection project(t);
  if (project.is_beyond_side(t, segment)) return false;
  const auto side = [&](const glm::dvec3& p) {
    return orientation(project(segment[0]), project(segment[1]), project(p));
  };
  return !is_one_sided({side(t[0]), side(t[1]), side(t[2])});
}

/// `from`, `to`: the sides of the triangle's plane on which the ends are.
bool do_intersect(const std::array<glm::dvec3, 2>& segment, int from, int to,
                  const ExactTriangle& t) {
  if (from * to > 0) return false;
  if (from == 0 && to == 0) return do_coplanar_intersect(segment, t);
  // The segment reaches the plane, so only its line matters: it meets the triangle exactly if it
  // passes all three sides on the same side.
  const auto& [p, q] = segment;
  const int first = orientation(p, q, t[0], t[1]);
  const int second = orientation(p, q, t[1], t[2]);
  if (first * second < 0) return false;
  const int third = orientation(p, q, t[2], t[0]);
  return first * third >= 0 && second * third >= 0;
}

/// Rotates the corners until the first is alone on its side of the plane: the other two are on the
/// other side or in the plane. Returns the sign of the first corner's side.
int turn_single_corner_first(ExactTriangle& t, const Signs& s) {
  for (const int side : {1, -1}) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      if (side * s[i] < 0 || side * s[j] > 0 || side * s[k] > 0) continue;
      // A corner in the plane is alone there only if both others are off it.
      if (s[i] == 0 && s[j] * s[k] == 0) continue;
      t = {t[i], t[j], t[k]};
      return side;
    }
  }
  return 0;
}

/// Each triangle intersects the common line of both planes in a segment. Once both triangles are
/// rotated so that their first corners are alone and on the positive side of the other's plane, two
/// orientations of sides tell whether the segments overlap.
bool do_planes_segments_overlap(ExactTriangle a, const Signs& a_sides, ExactTriangle b,
                                const Signs& b_sides) {
  const int a_side = turn_single_corner_first(a, a_sides);
  const int b_side = turn_single_corner_first(b, b_sides);
  if (a_side < 0) std::swap(b[1], b[2]);
  if (b_side < 0) std::swap(a[1], a[2]);
  return orientation(a[0], a[1], b[0], b[1]) <= 0 && orientation(a[0], b[0], a[2], b[2]) <= 0;
}

bool do_separate_intersect(const ExactTriangle& a, const ExactTriangle& b) {
  const Signs a_sides = sides(b, a);
  if (is_one_sided(a_sides)) return false;
  if (is_zero(a_sides)) return do_coplanar_intersect(a, b);
  const Signs b_sides = sides(a, b);
  if (is_one_sided(b_sides)) return false;
  return do_planes_segments_overlap(a, a_sides, b, b_sides);
}

/// If the triangles meet outside the shared corner, the side opposite that corner in one of them
/// meets the other. Pre: the first corners are the shared one.
bool do_intersect_beyond_corner(const ExactTriangle& a, const ExactTriangle& b) {
  const int a1 = orientation(b[0], b[1], b[2], a[1]);
  const int a2 = orientation(b[0], b[1], b[2], a[2]);
  if (a1 * a2 > 0) return false;
  if (do_intersect(std::array{a[1], a[2]}, a1, a2, b)) return true;
  const int b1 = orientation(a[0], a[1], a[2], b[1]);
  const int b2 = orientation(a[0], a[1], a[2], b[2]);
  return do_intersect(std::array{b[1], b[2]}, b1, b2, a);
}

/// Pre: the first two corners of each are the shared ones, in either order.
bool is_folded(const ExactTriangle& a, const ExactTriangle& b) {
  if (orientation(a[0], a[1], a[2], b[2]) != 0) return false;
  const Projection project(a);
  return orientation(project(a[0]), project(a[1]), project(a[2])) ==
         orientation(project(a[0]), project(a[1]), project(b[2]));
}

ExactTriangle turned(const ExactTriangle& t, std::size_t first) {
  return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

}  // namespace

ExactTriangle exact_triangle(const Mesh& mesh, Face f) {
  return {mesh.position(mesh.origin(Mesh::halfedge(f, 0))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 1))),
          mesh.position(mesh.origin(Mesh::halfedge(f, 2)))};
}

bool is_degenerate(const ExactTriangle& t) {
  return orientation_without(t, 0) == 0 && orientation_without(t, 1) == 0 &&
         orientation_without(t, 2) == 0;
}

bool do_intersect(const ExactTriangle& a, const ExactTriangle& b) {
  std::size_t count = 0;
  std::array<std::size_t, 3> in_a{};
  std::array<std::size_t, 3> in_b{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (a[i] != b[k]) continue;
      in_a[count] = i;
      in_b[count++] = k;
      break;
    }
  }
  if (count == 0) return do_separate_intersect(a, b);
  if (count == 1) return do_intersect_beyond_corner(turned(a, in_a[0]), turned(b, in_b[0]));
  if (count == 3) return true;
  const auto edge_first = [](const ExactTriangle& t, std::size_t i, std::size_t k) {
    return ExactTriangle{t[i], t[k], t[3 - i - k]};
  };
  return is_folded(edge_first(a, in_a[0], in_a[1]), edge_first(b, in_b[0], in_b[1]));
}

bool do_areas_intersect(const ExactTriangle& a, const ExactTriangle& b) {
  return !is_degenerate(a) && !is_degenerate(b) && do_intersect(a, b);
}

}  // namespace mesher::analysis
