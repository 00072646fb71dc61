#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/mesh/ids.h"

namespace mesher {

/// The arrays of a mesh that have a mirror on the GPU.
enum class GpuArray : std::uint8_t {
  position,    ///< one element a vertex
  origin,      ///< one element a half-edge: the index buffer
  edge_class,  ///< one element a half-edge: boundary, crease or ordinary, from twin and sharpness
};
inline constexpr std::size_t kGpuArrayCount = 3;

/// Elements [begin, end) of one array.
struct ChangedRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  friend bool operator==(const ChangedRange&, const ChangedRange&) = default;
};

/// Which elements of which GPU arrays edits have touched since the log was last cleared. Noting is
/// O(1); a range that continues or repeats the one noted before it is merged at once. Past
/// kMaxRanges ranges, or where there is no memory for more, an array counts as changed whole:
/// sorting them would cost more than copying. Noting never fails.
class ChangeLog {
 public:
  static constexpr std::size_t kMaxRanges = 100'000;

  void note(GpuArray array, std::uint32_t first, std::uint32_t count = 1) {
    if (!whole_[index(array)] && count > 0) add(array, first, count);
  }
  /// Everything may differ (a new mesh in the same place).
  void note_all();
  void clear();

  bool is_empty() const;
  /// True where the array must be copied whole.
  bool is_whole(GpuArray array) const { return whole_[index(array)]; }
  /// The noted ranges, sorted, disjoint, and joined where at most `gap` elements lie between; cut
  /// off at `count`, the number of elements that are left. O(n log n) in their number. Empty where
  /// `is_whole`.
  std::vector<ChangedRange> merged(GpuArray array, std::uint32_t gap = 0,
                                   std::uint32_t count = kNone) const;

 private:
  void add(GpuArray array, std::uint32_t first, std::uint32_t count);
  static std::size_t index(GpuArray array) { return static_cast<std::size_t>(array); }

  std::array<std::vector<ChangedRange>, kGpuArrayCount> ranges_;
  std::array<bool, kGpuArrayCount> whole_{};
};

}  // namespace mesher
