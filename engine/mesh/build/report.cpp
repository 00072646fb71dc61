#include "engine/mesh/build/report.h"

#include <algorithm>

namespace mesher {

// Joining equal positions is no repair: STL has no shared vertices, and glTF splits them where
// attributes differ.
bool BuildReport::is_clean() const {
  BuildReport repairs = *this;
  repairs[Repair::vertices_joined] = 0;
  return std::all_of(repairs.counts_.begin(), repairs.counts_.end(),
                     [](std::uint64_t n) { return n == 0; });
}

BuildReport& BuildReport::operator+=(const BuildReport& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i)
    counts_[i] += other.counts_[i];
  return *this;
}

}  // namespace mesher
