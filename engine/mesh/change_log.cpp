#include "engine/mesh/change_log.h"

#include <algorithm>
#include <new>

namespace mesher {

void ChangeLog::add(GpuArray array, std::uint32_t first, std::uint32_t count) {
  const std::size_t i = index(array);
  std::vector<ChangedRange>& ranges = ranges_[i];
  if (!ranges.empty()) {
    ChangedRange& last = ranges.back();
    if (first >= last.begin && first <= last.end) {
      last.end = std::max(last.end, first + count);
      return;
    }
  }
  if (ranges.size() < kMaxRanges) {
    try {
      ranges.push_back({first, first + count});
      return;
    } catch (const std::bad_alloc&) {
      // Fall through, as with too many ranges: a whole copy is slower, but a failed edit loses the
      // mesh.
    }
  }
  whole_[i] = true;
  ranges.clear();
}

void ChangeLog::note_all() {
  for (std::size_t i = 0; i < kGpuArrayCount; ++i) {
    whole_[i] = true;
    ranges_[i].clear();
  }
}

void ChangeLog::clear() {
  for (std::size_t i = 0; i < kGpuArrayCount; ++i) {
    whole_[i] = false;
    ranges_[i].clear();
  }
}

bool ChangeLog::is_empty() const {
  for (std::size_t i = 0; i < kGpuArrayCount; ++i) {
    if (whole_[i] || !ranges_[i].empty()) return false;
  }
  return true;
}

std::vector<ChangedRange> ChangeLog::merged(GpuArray array, std::uint32_t gap,
                                            std::uint32_t count) const {
  std::vector<ChangedRange> sorted = ranges_[index(array)];
  const auto is_before = [](ChangedRange a, ChangedRange b) { return a.begin < b.begin; };
  if (!std::is_sorted(sorted.begin(), sorted.end(), is_before)) {
    std::sort(sorted.begin(), sorted.end(), is_before);
  }
  std::vector<ChangedRange> joined;
  for (ChangedRange range : sorted) {
    range.end = std::min(range.end, count);
    if (range.begin >= range.end) continue;
    if (!joined.empty() && range.begin <= joined.back().end + gap) {
      joined.back().end = std::max(joined.back().end, range.end);
    } else {
      joined.push_back(range);
    }
  }
  return joined;
}

}  // namespace mesher
