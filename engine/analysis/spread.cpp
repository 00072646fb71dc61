#include "engine/analysis/spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace mesher::analysis {

Spread::Spread(std::vector<float> values) : values_(std::move(values)) {
  std::erase_if(values_, [](float value) { return !std::isfinite(value); });
  std::sort(values_.begin(), values_.end());
  double sum = 0.0;
  double squares = 0.0;
  for (const float value : values_) {
    sum += double{value};
    squares += double{value} * double{value};
  }
  if (values_.empty()) return;
  const auto n = static_cast<double>(values_.size());
  mean_ = sum / n;
  rms_ = std::sqrt(squares / n);
}

double Spread::percentile(double share) const {
  if (values_.empty()) return 0.0;
  const double rank = std::ceil(share * static_cast<double>(values_.size()));
  const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  return double{values_[std::min(index, values_.size() - 1)]};
}

}  // namespace mesher::analysis
