#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// A triangle. Each coordinate is the value of a finite float, stored as a double because the
/// predicates compute in double.
using ExactTriangle = std::array<glm::dvec3, 3>;

/// Returns the triangle of a face. O(1). Pre: the face is not removed.
ExactTriangle exact_triangle(const Mesh& mesh, Face f);

/// Returns whether the corners are collinear (or fewer than three points). Exact. O(1).
bool is_degenerate(const ExactTriangle& t);

/// Returns whether two triangles, including their sides and interiors, meet in more than the
/// corners and sides that they share. Corners are shared if their positions are equal, so that
/// vertices that were cut apart at the same position count as one. Exact. O(1). Pre: neither is
/// degenerate.
///
/// - No shared corner: whether they have a point in common, including a touch (P. Guigue,
///   O. Devillers, "Fast and robust triangle-triangle overlap test using orientation predicates",
///   2003).
/// - One: whether they meet in more than that corner.
/// - Two: whether they overlap, one folded onto the other.
/// - Three: always.
bool do_intersect(const ExactTriangle& a, const ExactTriangle& b);

/// Same, for any triangles: one that is degenerate intersects none.
bool do_areas_intersect(const ExactTriangle& a, const ExactTriangle& b);

}  // namespace mesher::analysis
