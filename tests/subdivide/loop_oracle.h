#pragma once

#include <span>
#include <vector>

#include "tests/subdivide/plain_mesh.h"

namespace mesher::test {

/// What a vertex is to its edges, as Hoppe 1994 names it. DeRose 1998 makes no difference between
/// the two kinds of crease vertices.
enum class Kind { smooth, dart, regular_crease, other_crease, corner };

/// How far a new point on a sharp edge lies from its first end: by the kinds of its ends. Negative:
/// the edge uses the smooth mask.
using SharpEdgeRule = double (*)(Kind, Kind);

/// A family of rules: what sharp edges do, and how sharpness falls.
struct OracleRules {
  SharpEdgeRule sharp_edge = nullptr;
  CreaseDecay decay = CreaseDecay::uniform;
  /// Leaves out the clamp in the blend of an edge that gets smooth. Wrong, and what OpenSubdiv
  /// does.
  bool overshoots = false;
};

/// Sharpness of the half of an edge at one of its ends, where `others` are the other edges there.
double child_sharpness(double sharpness, std::span<const double> others, CreaseDecay decay);

/// One level.
PlainMesh refine(const PlainMesh& mesh, const OracleRules& rules);

/// Where the vertices of `mesh` go: its neighbourhood is subdivided until nothing moves. By no
/// formula for limits, so that it can judge them.
std::vector<Point> limit_positions(const PlainMesh& mesh, const OracleRules& rules);

/// Unit normal of the limit surface at each corner of each triangle, found the same way: by what
/// the faces between two creases, or all of them, turn to as they shrink. The zero vector where
/// that does not settle soon enough to be told (many faces at the vertex), or at corners, where the
/// limit may be no plane at all.
std::vector<Point> limit_normals(const PlainMesh& mesh, const OracleRules& rules);

}  // namespace mesher::test
