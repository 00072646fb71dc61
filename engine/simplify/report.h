#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace mesher {

/// Why simplification ended.
enum class StopReason : std::uint8_t {
  target_reached,
  already_there,      ///< the input had no more faces than asked for
  no_legal_collapse,  ///< every edge left is refused; see the rejections
  error_bound,        ///< every edge left would exceed the error bound (or is refused)
  far_from_input,     ///< SimplifyOptions::stop_before_error
};

/// Why single collapses were refused.
enum class Rejection : std::uint8_t {
  link_condition,  ///< would change the topology, or make an edge of three faces
  boundary,        ///< would pinch, close or move a boundary that is kept
  crease,          ///< would bend a crease or take a corner
  fold_over,       ///< a face would turn over, against its neighbors or its original
  error_bound,     ///< would go further from the input than allowed
  intersection,    ///< would make two faces intersect
};
inline constexpr std::size_t kRejectionCount = 6;

/// snake_case key for JSON.
std::string_view key(StopReason reason);
std::string_view key(Rejection rejection);
/// A person's words: "target reached", "link condition".
std::string_view describe(StopReason reason);
std::string_view describe(Rejection rejection);

/// Seconds by phase.
struct SimplifyTimes {
  double prepare = 0.0;  ///< vertex order, quadrics, first costs
  double collapse = 0.0;
  double finish = 0.0;   ///< the result's order
  double measure = 0.0;  ///< of the error, where a bound was asked for or certified
  double total() const { return prepare + collapse + finish + measure; }
  SimplifyTimes& operator+=(const SimplifyTimes& other) {
    prepare += other.prepare;
    collapse += other.collapse;
    finish += other.finish;
    measure += other.measure;
    return *this;
  }
};

/// The ledger: what was asked, what was reached, and why it ended.
struct SimplifyReport {
  std::uint32_t faces_before = 0;
  std::uint32_t faces_asked = 0;  ///< 0: as far as it goes
  std::uint32_t faces_reached = 0;
  std::uint32_t vertices_before = 0;
  std::uint32_t vertices_reached = 0;
  StopReason reason = StopReason::target_reached;
  std::uint64_t collapses = 0;
  /// Refusals by cause: how many times an edge was tried and refused; where the target was missed,
  /// also the edges left that features forbid, which are never tried.
  std::array<std::uint64_t, kRejectionCount> rejected{};
  /// The root mean square distance between input and result, both ways, model units: measured at
  /// some points of the input, and estimated from the costs paid for the other way. Within a fifth.
  double estimated_error = 0.0;
  /// The largest distance between input and result that was measured, both ways, model units;
  /// negative where no bound was asked for.
  double measured_error = -1.0;
  /// No point of the input or of the result is farther from the other, model units; negative where
  /// that was not asked for.
  double certified_bound = -1.0;
  /// What `simplify_pruned` left out: parts, their faces, the diagonal of the largest one's box
  /// (model units), and the estimated error of the result if it had kept them.
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

}  // namespace mesher
