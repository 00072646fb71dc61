#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "engine/core/progress.h"

namespace mesher {

class CollapseObserver;

/// What makes a collapse cheap: which edge goes first.
enum class CostPolicy : std::uint8_t {
  /// Squared distance to the planes of the faces as they are now, weighted by area, at a place that
  /// keeps the volume (the default). Goal: the smallest distance to the input.
  quadric,
  /// Quadrics gathered along all collapses (M. Garland, P. Heckbert, "Surface simplification using
  /// quadric error metrics", 1997). Goal: the classic, for comparison.
  accumulated_quadric,
  /// The shortest legal edge. Goal: even spacing, at the price of accuracy.
  edge_length,
  /// Triangles as near to equilateral as can be, for meshes that something is computed on.
  shape,
  /// Any legal edge, all equally likely, seeded. Goal: a baseline, and a test of the rest.
  random,
};
inline constexpr std::size_t kCostPolicyCount = 5;

/// Where the vertex goes that two become.
enum class Placement : std::uint8_t {
  optimal,   ///< where the cost is least
  midpoint,  ///< the middle of the edge
  endpoint,  ///< whichever end costs less: positions stay a subset of the input's
};
inline constexpr std::size_t kPlacementCount = 3;

/// What becomes of boundary edges.
enum class BoundaryRule : std::uint8_t {
  preserve,  ///< loops are kept and simplified along themselves
  lock,      ///< no vertex on a boundary moves or vanishes
};

/// In which order the result's vertices and faces come.
enum class ResultOrder : std::uint8_t {
  input,       ///< survivors in the order in which the input had them
  fill_holes,  ///< survivors stay in their places, the last ones move into the holes: least changes
};

/// "quadric", "optimal" …: as the command line and JSON spell it.
std::string_view key(CostPolicy policy);
std::string_view key(Placement placement);

/// How many times the true distance a certified bound may be.
inline constexpr double kBoundRatio = 5.0;
/// The same for a model of so many faces: of a small one an exact bound takes no time.
inline double bound_ratio(std::uint32_t faces) {
  constexpr std::uint32_t kFewFaces = 4096;
  return faces <= kFewFaces ? 1.1 : kBoundRatio;
}

/// Where the RMS distance from the input passes this part of the diagonal, a model is hard to
/// recognize.
inline constexpr double kFarFromInput = 0.05;

/// What to simplify to, and by which rules. The first target reached ends the work.
struct SimplifyOptions {
  std::uint32_t target_faces = 0;  ///< 0: as far as it goes
  /// Upper bound for the distance between input and result, both ways, in model units; infinite:
  /// none. Pre: not negative.
  double max_error = std::numeric_limits<double>::infinity();
  /// Find an upper bound for that distance (SimplifyReport::certified_bound), at most bound_ratio
  /// times the distance itself. Always found where there is a max_error.
  bool certifies = false;
  /// Stop before the estimated error (SimplifyReport::estimated_error) passes this, in model units;
  /// infinite: do not. It is estimated in steps, so more faces may be left than must be: a tenth as
  /// a rule, four times as many where the error jumps. Pre: not negative.
  double stop_before_error = std::numeric_limits<double>::infinity();
  /// The error ends the work only where fewer faces than this are left.
  std::uint32_t stop_below_faces = std::numeric_limits<std::uint32_t>::max();

  CostPolicy cost = CostPolicy::quadric;
  Placement placement = Placement::optimal;
  BoundaryRule boundary = BoundaryRule::preserve;
  /// Edges whose faces turn by more count as creases, besides those that are tagged. 180: none.
  float crease_angle_deg = 180.0F;
  std::uint64_t seed = 1;  ///< of the random policy
  /// Refuses collapses that would make two faces intersect that do not yet (`do_intersect` in
  /// engine/analysis/triangle_pair.h says what counts).
  bool no_intersections = false;

  ResultOrder order = ResultOrder::input;
  CollapseObserver* observer = nullptr;  ///< told of every collapse
  Progress* progress = nullptr;
};

}  // namespace mesher
