#pragma once

#include <cstdint>
#include <span>

#include "engine/subdivide/options.h"

namespace mesher {

/// Weights of one vertex and of each of its neighbours, which all weigh the same.
struct RingMask {
  double own = 1.0;
  double each = 0.0;
};

// Loop's masks (C. Loop, "Smooth subdivision surfaces based on triangles", 1987), with the weights
// of the thesis. O(1) each.

/// Where an interior vertex of `valence` neighbours goes. Pre: valence >= 3.
RingMask loop_vertex_mask(std::uint32_t valence);
/// Where it goes in the end. Pre: valence >= 3.
RingMask loop_limit_mask(std::uint32_t valence);
/// A new vertex on a smooth edge: so much of each end, and of each vertex opposite.
inline constexpr double kLoopEdgeEnd = 3.0 / 8.0;
inline constexpr double kLoopEdgeOpposite = 1.0 / 8.0;

/// What the sharp edges make of a vertex (H. Hoppe et al., "Piecewise smooth surface
/// reconstruction", 1994, figure 4). A boundary edge is sharp.
enum class VertexKind : std::uint8_t {
  smooth,          ///< no sharp edge
  dart,            ///< one
  regular_crease,  ///< two, with three faces on each side (or on the only side, on a boundary)
  crease,          ///< two, other than that
  corner,          ///< three and more, or sharp by itself
};

/// A vertex on a crease: of itself and of each of its two neighbours on it.
inline constexpr RingMask kCreaseVertexMask{3.0 / 4.0, 1.0 / 8.0};

/// Where a vertex on a crease goes in the end.
RingMask crease_limit_mask(CreaseRules rules, VertexKind kind);

/// How much a new vertex on a sharp edge takes of the end whose kind comes first; the rest is of
/// the other. Pre: `has_sharp_mask`.
double sharp_edge_weight(CreaseRules rules, VertexKind first, VertexKind second);
/// False where the edge takes the smooth mask although it is sharp: Hoppe's at a dart.
bool has_sharp_mask(CreaseRules rules, VertexKind first, VertexKind second);

/// Tangent across a crease, from the neighbours e1..en on one side in order, ends included: it
/// points to that side. Writes n weights of neighbours, returns the vertex's own. Pre: n >= 2, the
/// vertex is on a crease. O(n). The left eigenvector of the masks in use: Hoppe's where they are
/// 3/8 and 5/8, another where they are 1/2 and 1/2, that is, at his regular vertices and everywhere
/// by DeRose (OpenSubdiv 3.5 takes Hoppe's there and is off by up to 2.9 degrees).
double across_crease_tangent(CreaseRules rules, VertexKind kind, std::span<double> neighbours);

// Butterfly (N. Dyn, D. Levin, J. Gregory, "A butterfly subdivision scheme for surface
// interpolation with tension control", 1990; D. Zorin, P. Schroeder, W. Sweldens, "Interpolating
// subdivision for meshes with arbitrary topology", 1996; tension 0).

inline constexpr double kButterflyEnd = 1.0 / 2.0;
inline constexpr double kButterflyOpposite = 1.0 / 8.0;
inline constexpr double kButterflyWing = -1.0 / 16.0;
/// A new vertex on an edge at a vertex of other than six neighbours: this much of the vertex
/// itself, and `butterfly_ring_weight` of its neighbour `i`, counted from the edge on.
inline constexpr double kButterflyCentre = 3.0 / 4.0;
double butterfly_ring_weight(std::uint32_t valence, std::uint32_t i);
/// On a boundary or crease: of the ends, and of the next vertices along it.
inline constexpr double kFourPointEnd = 9.0 / 16.0;
inline constexpr double kFourPointNext = -1.0 / 16.0;

}  // namespace mesher
