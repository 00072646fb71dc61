#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/mesh/ids.h"

namespace mesher {

/// The arrays of a mesh and its attributes that are mirrored on the GPU.
enum class GpuArray : std::uint8_t {
  position,    ///< one element per vertex
  origin,      ///< one element per half-edge: the index buffer
  edge_class,  ///< one element per half-edge: boundary, crease or ordinary, from twin and sharpness
  corner_wedge,  ///< one element per half-edge
  wedge_value,   ///< one element per wedge, in every layer
};
inline constexpr std::size_t kGpuArrayCount = 5;

/// The elements [begin, end) of an array.
struct ChangedRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  friend bool operator==(const ChangedRange&, const ChangedRange&) = default;
};

/// The elements of each GPU array that edits have changed since the log was last cleared. Noting a
/// change is O(1); a range that continues or repeats the previous one is merged into it. An array
/// counts as wholly changed after more than kMaxRanges ranges, when sorting them would cost more
/// than copying the array, or if there is no memory for more. Noting never fails.
class ChangeLog {
 public:
  static constexpr std::size_t kMaxRanges = 100'000;

  void note(GpuArray array, std::uint32_t first, std::uint32_t count = 1) {
    if (!whole_[index(array)] && count > 0) add(array, first, count);
  }
  /// Notes that everything may differ (a new mesh in the same object).
  void note_all();
  void clear();

  bool is_empty() const;
  /// Returns whether nothing is noted of one array.
  bool is_empty(GpuArray array) const {
    return !whole_[index(array)] && ranges_[index(array)].empty();
  }
  /// Returns whether the whole array must be copied.
  bool is_whole(GpuArray array) const { return whole_[index(array)]; }
  /// Returns the noted ranges, sorted and disjoint. Ranges with at most `gap` elements between them
  /// are joined, and ranges are clipped to `count`, the current number of elements. Empty if
  /// `is_whole`. O(n log n) in their number.
  std::vector<ChangedRange> merged(GpuArray array, std::uint32_t gap = 0,
                                   std::uint32_t count = kNone) const;

 private:
  void add(GpuArray array, std::uint32_t first, std::uint32_t count);
  static std::size_t index(GpuArray array) { return static_cast<std::size_t>(array); }

  std::array<std::vector<ChangedRange>, kGpuArrayCount> ranges_;
  std::array<bool, kGpuArrayCount> whole_{};
};

}  // namespace mesher
