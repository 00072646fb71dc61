#pragma once

#include <array>
#include <cstdint>

#include "engine/core/choice.h"

namespace mesher::simplify {

/// Why simplification stopped.
enum class StopReason : std::uint8_t {
  target_reached,
  already_there,      ///< the input had no more faces than requested
  no_legal_collapse,  ///< every remaining edge is refused; see the rejections
  error_bound,        ///< every remaining edge would exceed the error bound, or is refused
  far_from_input,     ///< SimplifyOptions::stop_before_error
};
inline constexpr Choices<StopReason, 5> kStopReasons{{
    {StopReason::target_reached, {"target_reached", "target reached"}},
    {StopReason::already_there, {"already_there", "already had no more faces than requested"}},
    {StopReason::no_legal_collapse, {"no_legal_collapse", "no legal collapse is left"}},
    {StopReason::error_bound,
     {"error_bound", "every remaining collapse would exceed the error bound"}},
    {StopReason::far_from_input, {"far_from_input", "fewer faces would be too far from the input"}},
}};
static_assert(is_complete(kStopReasons));
constexpr const auto& choices(StopReason) {
  return kStopReasons;
}

/// Why a collapse was refused.
enum class Rejection : std::uint8_t {
  link_condition,  ///< would change the topology or give an edge three faces
  boundary,        ///< would pinch, close or move a boundary that is kept
  crease,          ///< would bend a crease or remove a corner
  fold_over,       ///< a face would turn over or become degenerate
  error_bound,     ///< would exceed the allowed distance from the input
  intersection,    ///< would make two faces intersect
};
inline constexpr Choices<Rejection, 6> kRejections{{
    {Rejection::link_condition, {"link_condition", "link condition"}},
    {Rejection::boundary, {"boundary", "boundary"}},
    {Rejection::crease, {"crease", "crease"}},
    {Rejection::fold_over, {"fold_over", "fold-over"}},
    {Rejection::error_bound, {"error_bound", "error bound"}},
    {Rejection::intersection, {"intersection", "self-intersection"}},
}};
static_assert(is_complete(kRejections));
constexpr const auto& choices(Rejection) {
  return kRejections;
}

/// Seconds per phase.
struct SimplifyTimes {
  double prepare = 0.0;  ///< vertex order, quadrics, first costs
  double collapse = 0.0;
  double finish = 0.0;   ///< ordering of the result
  double measure = 0.0;  ///< of the error, if a bound was requested or certified
  double total() const { return prepare + collapse + finish + measure; }
  SimplifyTimes& operator+=(const SimplifyTimes& other) {
    prepare += other.prepare;
    collapse += other.collapse;
    finish += other.finish;
    measure += other.measure;
    return *this;
  }
};

/// Report of a simplification: request, result, and why it ended.
struct SimplifyReport {
  std::uint32_t faces_before = 0;
  std::uint32_t faces_asked = 0;  ///< 0: as few as possible
  std::uint32_t faces_reached = 0;
  std::uint32_t vertices_before = 0;
  std::uint32_t vertices_reached = 0;
  StopReason reason = StopReason::target_reached;
  std::uint64_t collapses = 0;
  /// Number of refused edges by cause. Each edge counts once, by its first refusal, although it may
  /// be tried again or be collapsed later. If the target was missed, also the remaining edges that
  /// features forbid, which are never tried.
  std::array<std::uint64_t, kRejections.size()> rejected{};
  /// Estimated root mean square distance between input and result, both directions, in model units.
  /// Measured at some points of the input; the other direction is estimated from the paid costs.
  /// Within 20 %.
  double estimated_error = 0.0;
  /// Largest measured distance between input and result, both directions, in model units; negative
  /// if no bound was requested.
  double measured_error = -1.0;
  /// Upper bound of the distance from any point of the input or the result to the other surface, in
  /// model units; negative if not requested.
  double certified_bound = -1.0;
  /// Parts that `simplify_pruned` removed: their number, their faces, the diagonal of the largest
  /// bounding box (model units), and the estimated error of the result if it had kept them.
  std::uint32_t pruned_parts = 0;
  std::uint32_t pruned_faces = 0;
  double largest_pruned = 0.0;
  double error_unpruned = 0.0;
  SimplifyTimes seconds;

  std::uint64_t& operator[](Rejection cause) { return rejected[static_cast<std::size_t>(cause)]; }
  std::uint64_t operator[](Rejection cause) const {
    return rejected[static_cast<std::size_t>(cause)];
  }
};

}  // namespace mesher::simplify
