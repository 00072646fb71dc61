#pragma once

/// @file
/// @brief Options and report of a simplification.

#include <mesher/progress.h>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

namespace mesher {

/// Which edge is collapsed first.
enum class CostPolicy {
  quadric,              ///< least squared distance to the planes of the faces; the best shape
  accumulated_quadric,  ///< Garland and Heckbert 1997, for comparison
  edge_length,          ///< the shortest edge: even spacing
  shape,                ///< triangles as close to equilateral as possible
  random,               ///< all legal edges are equally likely: a baseline
};

/// Where the merged vertex of a collapse is placed.
enum class Placement {
  optimal,   ///< where the cost is least
  midpoint,  ///< in the middle of the edge
  endpoint,  ///< at the cheaper end: positions stay a subset of the input's
};

/// How boundary edges are simplified.
enum class BoundaryRule {
  preserve,  ///< along the boundary; loops are kept
  lock,      ///< no boundary vertex moves or is removed
};

/// How much attributes count against the shape: a difference times its weight counts like a
/// distance. 0: not at all. Only CostPolicy::quadric counts attributes.
struct AttributeWeights {
  float texcoord = 0.3F;  ///< how far a texture slides over the surface
  float normal = 0.2F;    ///< 1: a radian counts like a hundredth of the diagonal
  float color = 0.5F;     ///< 1: black against white counts like a hundredth of the diagonal
  float joint = 0.03F;    ///< how far apart the parts are that a vertex follows by its skin
};

/// One edge collapse. All numbers are those of the input, and are never reused.
struct EdgeCollapse {
  std::uint32_t removed = 0;        ///< the vertex that is gone
  std::uint32_t kept = 0;           ///< the vertex that it was merged with
  std::array<float, 3> position{};  ///< the new position of `kept`
  std::uint32_t face = 0;           ///< a face that is gone
  std::uint32_t other_face = 0;     ///< the other face that is gone; kNoElement on a boundary
};

/// The targets of a simplification, and its rules. It ends at the first target that it reaches.
struct SimplifyOptions {
  /// The number of faces to reach; 0: as few as possible.
  std::uint32_t target_faces = 0;
  /// Upper bound of the distance between input and result, in both directions, for all points, in
  /// model units. Pre: above 0.
  double max_error = std::numeric_limits<double>::infinity();
  CostPolicy cost = CostPolicy::quadric;           ///< which edge is collapsed first
  Placement placement = Placement::optimal;        ///< where the merged vertex is placed
  BoundaryRule boundary = BoundaryRule::preserve;  ///< how boundary edges are simplified
  /// Edges whose face normals differ by more are creases, too, in degrees. 180: only tagged ones.
  float crease_angle_deg = 180.0F;
  AttributeWeights weights{};  ///< Pre: each is 0 or more
  std::uint64_t seed = 1;      ///< of the random policy
  /// Refuse collapses that make two faces intersect.
  bool no_intersections = false;
  /// Remove whole parts that are smaller than the error. Pre: no `max_error` and no `collapsed`.
  bool prune = false;
  /// Compute SimplifyReport::certified_bound; with `max_error` it is always computed.
  bool certify = false;
  ProgressCallback progress{};  ///< may be empty
  /// The observer of the collapses: told of them in an order in which each is legal after those
  /// before it, several at a time, on the thread that called. The order and the collapses do not
  /// depend on the number of threads. If mesher has to simplify more than once, as it may with
  /// `max_error` or attributes, the observer sees the run that is returned, at its end. May be
  /// empty; an exception ends the simplification.
  std::function<void(std::span<const EdgeCollapse>)> collapsed{};
};

/// Why a simplification stopped.
enum class StopReason {
  target_reached,     ///< the number of faces was reached
  already_there,      ///< the input had no more faces than that
  no_legal_collapse,  ///< every remaining edge is refused, for the sake of topology or features
  error_bound,        ///< every remaining edge would exceed `max_error`, or is refused
  far_from_input,     ///< fewer faces would be too far from the input
};

/// What a simplification did.
struct SimplifyReport {
  std::uint32_t faces_before = 0;                  ///< of the input
  std::uint32_t faces_reached = 0;                 ///< of the result
  std::uint64_t collapses = 0;                     ///< number of collapsed edges
  StopReason reason = StopReason::target_reached;  ///< why it stopped
  /// Estimated root mean square distance between input and result, in model units. Within 20 %.
  double estimated_error = 0.0;
  /// Upper bound of the distance from any point of one surface to the other, in model units;
  /// negative: not computed.
  double certified_bound = -1.0;
  std::uint32_t pruned_parts = 0;  ///< parts that SimplifyOptions::prune removed
  /// The target could not be reached along seams of attributes, so some were simplified across.
  bool crosses_seams = false;
  double seconds = 0.0;  ///< the time that it took
};

}  // namespace mesher
