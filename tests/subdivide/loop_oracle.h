#pragma once

#include <span>
#include <vector>

#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// Kind of a vertex for the rules of its edges, named as in Hoppe 1994. DeRose 1998 does not
/// distinguish the two kinds of crease vertices.
enum class Kind { smooth, dart, regular_crease, other_crease, corner };

/// Position of a new point on a sharp edge, as a fraction from its first end, by the kinds of the
/// ends. Negative: the edge uses the smooth mask.
using SharpEdgeRule = double (*)(Kind, Kind);

/// A set of rules: masks of sharp edges and decay of sharpness.
struct OracleRules {
  SharpEdgeRule sharp_edge = nullptr;
  subdivide::CreaseDecay decay = subdivide::CreaseDecay::uniform;
  /// Omits the clamp in the blend of an edge that becomes smooth. This is wrong, but OpenSubdiv
  /// does it.
  bool overshoots = false;
};

/// Sharpness of the half of an edge at one of its ends. `others` are the other edges at that end.
double child_sharpness(double sharpness, std::span<const double> others,
                       subdivide::CreaseDecay decay);

/// Refines by one level.
PlainMesh refine(const PlainMesh& mesh, const OracleRules& rules);

/// Limit positions of the vertices of `mesh`, found by subdividing their neighborhoods until
/// nothing moves. Uses no limit formula, so that it can verify such formulas.
std::vector<Point> limit_positions(const PlainMesh& mesh, const OracleRules& rules);

/// Unit normals of the limit surface at each corner of each triangle, found the same way: from the
/// direction of the shrinking faces between two creases, or of all faces. The zero vector where the
/// direction converges too slowly (many faces at the vertex), and at corners, where the limit may
/// have no tangent plane.
std::vector<Point> limit_normals(const PlainMesh& mesh, const OracleRules& rules);

}  // namespace mesher::test
