#pragma once

#include <span>
#include <vector>

namespace mesher::analysis {

/// A measure at samples that stand for equal areas, and its statistics.
class Spread {
 public:
  Spread() = default;
  /// Leaves out values that are not finite: samples that cannot be measured. O(n log n).
  explicit Spread(std::vector<float> values);

  bool is_empty() const { return values_.empty(); }
  std::size_t count() const { return values_.size(); }
  /// Each figure is 0 if there are no values.
  double mean() const { return mean_; }
  double rms() const { return rms_; }
  double max() const { return is_empty() ? 0.0 : double{values_.back()}; }
  /// Returns the least value that at least this share of all values does not exceed (0 to 1).
  double percentile(double share) const;

 private:
  std::vector<float> values_;  ///< ascending
  double mean_ = 0.0;
  double rms_ = 0.0;
};

/// A measure in both directions. A two-sided figure is the larger of both, as of distances.
struct TwoSidedSpread {
  Spread forward;   ///< at samples of the first surface, against the second
  Spread backward;  ///< at samples of the second surface, against the first

  bool is_empty() const { return forward.is_empty() && backward.is_empty(); }
};

}  // namespace mesher::analysis
