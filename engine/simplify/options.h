#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "engine/core/choice.h"
#include "engine/core/option.h"
#include "engine/core/progress.h"
#include "engine/simplify/attribute_metric.h"

namespace mesher::simplify {

class CollapseObserver;

/// Which edge is collapsed first.
enum class CostPolicy : std::uint8_t {
  /// Squared distance to the planes of the current faces, weighted by area, at a position that
  /// preserves the volume (the default).
  /// Goal: the smallest distance to the input.
  quadric,
  /// Quadrics accumulated along all collapses (M. Garland, P. Heckbert, "Surface simplification
  /// using quadric error metrics", 1997). Goal: the classic method, for comparison.
  accumulated_quadric,
  /// The shortest legal edge. Goal: even spacing, at the cost of accuracy.
  edge_length,
  /// Triangles as close to equilateral as possible, for meshes used in numerical computation.
  shape,
  /// Any legal edge, all equally likely, seeded. Goal: a baseline, and a test of the rest.
  random,
};
inline constexpr Choices<CostPolicy, 5> kCostPolicies{{
    {CostPolicy::quadric,
     {"quadric", "quadric",
      "The smallest distance to the input: squared distance to the planes of the current faces, "
      "weighted by area, at a position that preserves the volume.",
      "qem"}},
    {CostPolicy::accumulated_quadric,
     {"accumulated", "accumulated quadric",
      "The classic method of Garland and Heckbert, for comparison: quadrics accumulated along all "
      "collapses."}},
    {CostPolicy::edge_length,
     {"length", "edge length", "The shortest edge first: even spacing, at the cost of accuracy."}},
    {CostPolicy::shape,
     {"shape", "triangle shape",
      "Triangles as close to equilateral as possible, for meshes used in numerical computation."}},
    {CostPolicy::random,
     {"random", "random", "Any legal edge, all equally likely: a baseline for the others."}},
}};
static_assert(is_complete(kCostPolicies));
constexpr const auto& choices(CostPolicy) {
  return kCostPolicies;
}

/// Where the merged vertex of a collapse is placed.
enum class Placement : std::uint8_t {
  optimal,   ///< where the cost is least
  midpoint,  ///< the middle of the edge
  endpoint,  ///< the end of lower cost: positions stay a subset of the input's
};
inline constexpr Choices<Placement, 3> kPlacements{{
    {Placement::optimal, {"optimal", "optimal", "The position of least cost."}},
    {Placement::midpoint, {"midpoint", "midpoint", "The middle of the edge."}},
    {Placement::endpoint,
     {"endpoint", "endpoint",
      "The cheaper end of the edge: positions stay a subset of the input's."}},
}};
static_assert(is_complete(kPlacements));
constexpr const auto& choices(Placement) {
  return kPlacements;
}

/// How boundary edges are simplified.
enum class BoundaryRule : std::uint8_t {
  preserve,  ///< loops are kept and simplified along the boundary
  lock,      ///< no boundary vertex moves or is removed
};
inline constexpr Choices<BoundaryRule, 2> kBoundaryRules{{
    {BoundaryRule::preserve,
     {"preserve", "preserve", "Boundary loops are kept and are simplified along the boundary."}},
    {BoundaryRule::lock, {"lock", "lock", "No boundary vertex moves or is removed."}},
}};
static_assert(is_complete(kBoundaryRules));
constexpr const auto& choices(BoundaryRule) {
  return kBoundaryRules;
}

/// The order of the result's vertices and faces.
enum class ResultOrder : std::uint8_t {
  input,       ///< the order of the input
  fill_holes,  ///< survivors keep their indices and the last ones fill the holes: fewest changes
};

/// Largest allowed ratio of a certified bound to the true distance.
inline constexpr double kBoundRatio = 5.0;
/// The same for a model of this many faces. For a small model, a tight bound takes no time.
inline double bound_ratio(std::uint32_t faces) {
  constexpr std::uint32_t kFewFaces = 4096;
  return faces <= kFewFaces ? 1.1 : kBoundRatio;
}

/// Share of the diagonal. A model whose RMS distance from the input exceeds it is hard to
/// recognize.
inline constexpr double kFarFromInput = 0.05;

/// The targets of a simplification, and its rules. It ends at the first target reached.
struct SimplifyOptions {
  std::uint32_t target_faces = 0;  ///< 0: as few as possible
  /// Upper bound on the distance between input and result, in both directions, in model units;
  /// infinite: none. Pre: not negative.
  double max_error = std::numeric_limits<double>::infinity();
  /// Compute an upper bound on that distance (SimplifyReport::certified_bound), at most bound_ratio
  /// times the distance itself. It is always computed if there is a max_error.
  bool certifies = false;
  /// Stop before the estimated error (SimplifyReport::estimated_error) exceeds this, in model
  /// units; infinite: never. The error is estimated in steps, so more faces may be left than
  /// necessary: usually a tenth more, up to four times as many if the error jumps. Pre: not
  /// negative.
  double stop_before_error = std::numeric_limits<double>::infinity();
  /// `stop_before_error` applies only when fewer faces than this are left.
  std::uint32_t stop_below_faces = std::numeric_limits<std::uint32_t>::max();

  CostPolicy cost = CostPolicy::quadric;
  Placement placement = Placement::optimal;
  BoundaryRule boundary = BoundaryRule::preserve;
  /// Edges whose face normals differ by more count as creases, besides those that are tagged. 180:
  /// none.
  float crease_angle_deg = 180.0F;
  std::uint64_t seed = 1;  ///< of the random policy
  /// Refuses collapses that would make two faces intersect that did not before (`do_intersect` in
  /// engine/analysis/triangle_pair.h defines an intersection).
  bool no_intersections = false;

  /// Attributes of the mesh that the default cost counts; null: none. simplify_model sets it.
  const AttributeMetric* metric = nullptr;
  /// Edges that mark_seams has marked may be crossed where that costs less than to stay on them.
  /// Only with a metric. simplify_model sets it.
  bool crosses_seams = false;

  /// See AttributeWeights.
  float weight_uv = AttributeWeights{}.texcoord;
  float weight_normal = AttributeWeights{}.normal;
  float weight_color = AttributeWeights{}.color;
  float weight_joint = AttributeWeights{}.joint;
  AttributeWeights weights() const {
    return {weight_uv, weight_normal, weight_color, weight_joint};
  }

  ResultOrder order = ResultOrder::input;
  CollapseObserver* observer = nullptr;  ///< told of every collapse
  Progress* progress = nullptr;

  friend bool operator==(const SimplifyOptions&, const SimplifyOptions&) = default;
};

inline constexpr double kMostWeight = 10.0;
inline bool counts_attributes(const SimplifyOptions& options) {
  return options.cost == CostPolicy::quadric;
}

/// The rules of simplification, which every command and panel that simplifies takes.
inline constexpr std::array kSimplifyRules{
    Option<SimplifyOptions>{.key = "cost",
                            .label = "cost",
                            .help = "which edge to collapse first",
                            .member = enum_member<&SimplifyOptions::cost>()},
    Option<SimplifyOptions>{.key = "placement",
                            .label = "placement",
                            .help = "position of the merged vertex",
                            .member = enum_member<&SimplifyOptions::placement>()},
    Option<SimplifyOptions>{.key = "boundary",
                            .label = "boundary",
                            .help = "whether boundary loops are simplified",
                            .member = enum_member<&SimplifyOptions::boundary>()},
    Option<SimplifyOptions>{
        .key = "crease-angle",
        .label = "crease angle",
        .help = "also treat edges whose face normals differ by more than this as creases",
        .member = &SimplifyOptions::crease_angle_deg,
        .unit = "deg",
        .most = 180.0,
        .special = {180.0, "tagged only"}},
    Option<SimplifyOptions>{
        .key = "seed",
        .label = "seed",
        .help = "seed of the random policy: the same seed gives the same mesh",
        .member = &SimplifyOptions::seed,
        .applies = [](const SimplifyOptions& o) { return o.cost == CostPolicy::random; }},
    Option<SimplifyOptions>{
        .key = "weight-uv",
        .label = "weight uv",
        .help = "how much a texture that slides counts against a surface that moves as far",
        .member = &SimplifyOptions::weight_uv,
        .most = kMostWeight,
        .applies = counts_attributes},
    Option<SimplifyOptions>{
        .key = "weight-normal",
        .label = "weight normal",
        .help = "how much normals count: 1 weighs a radian like a hundredth of the diagonal",
        .member = &SimplifyOptions::weight_normal,
        .most = kMostWeight,
        .applies = counts_attributes},
    Option<SimplifyOptions>{
        .key = "weight-color",
        .label = "weight color",
        .help = "how much colors count: 1 weighs black against white like a hundredth of the "
                "diagonal",
        .member = &SimplifyOptions::weight_color,
        .most = kMostWeight,
        .applies = counts_attributes},
    Option<SimplifyOptions>{
        .key = "weight-joint",
        .label = "weight joint",
        .help = "how much the joints of a skin count: 1 weighs a point that follows another part "
                "of the model like one that moves there",
        .member = &SimplifyOptions::weight_joint,
        .most = kMostWeight,
        .applies = counts_attributes},
    Option<SimplifyOptions>{.key = "no-intersections",
                            .label = "no intersections",
                            .help = "refuse collapses that make faces intersect",
                            .member = &SimplifyOptions::no_intersections},
};

}  // namespace mesher::simplify
