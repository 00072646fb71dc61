#include "engine/mesh/build/report.h"

#include <algorithm>

namespace mesher {

bool BuildReport::is_clean() const {
  return std::all_of(counts_.begin(), counts_.end(), [](std::uint64_t n) { return n == 0; });
}

}  // namespace mesher
