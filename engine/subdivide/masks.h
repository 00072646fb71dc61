#pragma once

#include <cstdint>
#include <span>

#include "engine/subdivide/options.h"

namespace mesher::subdivide {

/// The weight of a vertex, and the weight of each of its neighbors (the same for all).
struct RingMask {
  double own = 1.0;
  double each = 0.0;
};

// Loop's masks (C. Loop, "Smooth subdivision surfaces based on triangles", 1987), with the weights
// of the thesis. O(1) each.

/// Returns the mask for the next position of an interior vertex. Pre: valence >= 3.
RingMask loop_vertex_mask(std::uint32_t valence);
/// Returns the mask for the limit position of an interior vertex. Pre: valence >= 3.
RingMask loop_limit_mask(std::uint32_t valence);
/// The weights of each end, and of each opposite vertex, for a new vertex on a smooth edge.
inline constexpr double kLoopEdgeEnd = 3.0 / 8.0;
inline constexpr double kLoopEdgeOpposite = 1.0 / 8.0;

/// The kind of a vertex, given its sharp edges (H. Hoppe et al., "Piecewise smooth surface
/// reconstruction", 1994, figure 4). A boundary edge is sharp.
enum class VertexKind : std::uint8_t {
  smooth,          ///< no sharp edge
  dart,            ///< one sharp edge
  regular_crease,  ///< two, with three faces on each side (or on the only side, on a boundary)
  crease,          ///< two, any others
  corner,          ///< three or more, or sharp itself
};

/// The weights of a vertex on a crease, and of each of its two neighbors on the crease.
inline constexpr RingMask kCreaseVertexMask{3.0 / 4.0, 1.0 / 8.0};

/// Returns the mask for the limit position of a vertex on a crease.
RingMask crease_limit_mask(CreaseRules rules, VertexKind kind);

/// Returns the weight of the first end for a new vertex on a sharp edge; the second end has the
/// rest. Pre: `has_sharp_mask`.
double sharp_edge_weight(CreaseRules rules, VertexKind first, VertexKind second);
/// Returns false if a sharp edge uses the smooth mask: by Hoppe's rules, at a dart.
bool has_sharp_mask(CreaseRules rules, VertexKind first, VertexKind second);

/// Computes the tangent across a crease from the neighbors e1..en on one side in order, including
/// both ends on the crease; it points to that side. Writes the n weights of the neighbors and
/// returns the weight of the vertex. O(n). Pre: n >= 2, the vertex is on a crease.
///
/// The weights are the left eigenvector of the masks in use. Where these are 3/8 and 5/8, it is
/// Hoppe's. Where they are 1/2 and 1/2, it is another one: at Hoppe's regular vertices, and
/// everywhere by DeRose's rules. (OpenSubdiv 3.5 uses Hoppe's there too, with an error of up to 2.9
/// degrees.)
double across_crease_tangent(CreaseRules rules, VertexKind kind, std::span<double> neighbors);

// Butterfly (N. Dyn, D. Levin, J. Gregory, "A butterfly subdivision scheme for surface
// interpolation with tension control", 1990; D. Zorin, P. Schroeder, W. Sweldens, "Interpolating
// subdivision for meshes with arbitrary topology", 1996; tension 0).

inline constexpr double kButterflyEnd = 1.0 / 2.0;
inline constexpr double kButterflyOpposite = 1.0 / 8.0;
inline constexpr double kButterflyWing = -1.0 / 16.0;
/// The weight of an extraordinary vertex (valence other than 6) for a new vertex on one of its
/// edges. Its neighbor `i`, counted from the edge on, has the weight `butterfly_ring_weight`.
inline constexpr double kButterflyCenter = 3.0 / 4.0;
double butterfly_ring_weight(std::uint32_t valence, std::uint32_t i);
/// On a boundary or crease: the weights of the ends, and of the next vertices along it.
inline constexpr double kFourPointEnd = 9.0 / 16.0;
inline constexpr double kFourPointNext = -1.0 / 16.0;

}  // namespace mesher::subdivide
