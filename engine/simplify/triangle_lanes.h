#pragma once

#include "engine/core/lanes.h"

namespace mesher::simplify {

/// Four triangles at once.
struct TriangleLanes {
  Vec3<Float4> a, b, c;
};

inline Vec3<Float4> in_all_lanes(const Vec3<float>& v) {
  return {broadcast<Float4>(v.x), broadcast<Float4>(v.y), broadcast<Float4>(v.z)};
}
inline void set_lane(Vec3<Float4>& lanes, std::size_t lane, const Vec3<float>& v) {
  lanes.x[lane] = v.x;
  lanes.y[lane] = v.y;
  lanes.z[lane] = v.z;
}

/// Returns the squared distances of a point to four segments, where `q` is the vector from the
/// start of each segment to the point.
inline Float4 squared_distance_to_segments(const Vec3<Float4>& q, const Vec3<Float4>& side) {
  const auto all = [](float x) { return broadcast<Float4>(x); };
  const Float4 along = dot(q, side) / greater_of(dot(side, side), all(1e-30F));
  const Float4 part = smaller_of(greater_of(along, all(0.0F)), all(1.0F));
  const Vec3<Float4> off = q - side * part;
  return dot(off, off);
}

/// Returns the squared distances of a point to four triangles. Each is the smallest of the
/// distances to its sides and, if the point projects into the interior, to its plane. A triangle
/// without area reduces to its sides. Accurate to four to six digits of the triangle's size. O(1).
inline Float4 squared_distances(const Vec3<Float4>& point, const TriangleLanes& triangle) {
  const auto all = [](float x) { return broadcast<Float4>(x); };
  const Vec3<Float4> ab = triangle.b - triangle.a;
  const Vec3<Float4> bc = triangle.c - triangle.b;
  const Vec3<Float4> ca = triangle.a - triangle.c;
  const Vec3<Float4> from_a = point - triangle.a;
  const Vec3<Float4> from_b = point - triangle.b;
  const Vec3<Float4> from_c = point - triangle.c;
  const Float4 to_sides = smaller_of(smaller_of(squared_distance_to_segments(from_a, ab),
                                                squared_distance_to_segments(from_b, bc)),
                                     squared_distance_to_segments(from_c, ca));
  const Vec3<Float4> normal = cross(ab, bc);
  const Float4 square = dot(normal, normal);
  const Float4 above = dot(normal, from_a);
  const Float4 zero = all(0.0F);
  const Int4 is_inside = (dot(normal, cross(ab, from_a)) > zero) &
                         (dot(normal, cross(bc, from_b)) > zero) &
                         (dot(normal, cross(ca, from_c)) > zero);
  const Float4 to_plane = above * above / greater_of(square, all(1e-38F));
  return select(is_inside, smaller_of(to_plane, to_sides), to_sides);
}

inline float least_of(Float4 lanes) {
  const float low = lanes[0] < lanes[1] ? lanes[0] : lanes[1];
  const float high = lanes[2] < lanes[3] ? lanes[2] : lanes[3];
  return low < high ? low : high;
}

}  // namespace mesher::simplify
