#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/assert.h"
#include "engine/mesh/ids.h"

namespace mesher::simplify {

/// Links of a vertex in a queue. A vertex is in at most one queue at a time, so queues over
/// disjoint sets of vertices share one array.
struct QueueEntry {
  std::uint32_t next = kNone;
  std::uint32_t previous = kNone;
  std::uint32_t bucket = kNone;  ///< kNone: not in a queue
};

/// Queue of vertices by cost, cheapest first, to within 1/32 of an octave (2 %). Each bucket is
/// first-in first-out, so that equal costs spread over the surface instead of clustering. The
/// bucket is the upper bits of the float. All operations are O(1); front() is amortized over a
/// bitmap.
class BucketQueue {
  static constexpr std::uint32_t kShift = 18;

 public:
  static constexpr std::uint32_t kBuckets = 1U << (31U - kShift);

  explicit BucketQueue(std::span<QueueEntry> entries) : entries_(entries), ends_(kBuckets) {}

  /// Returns the bucket of a cost; monotone in `cost`. Any bit pattern yields a valid bucket. Pre:
  /// cost >= 0 (infinity included).
  static std::uint32_t bucket_of(float cost) {
    return (std::bit_cast<std::uint32_t>(cost) & 0x7FFFFFFFU) >> kShift;
  }
  /// Returns the highest cost in the buckets below this one; negative if there are none.
  static float highest_below(std::uint32_t bucket) {
    return bucket == 0 ? -1.0F : std::bit_cast<float>((bucket << kShift) - 1);
  }

  void push(Vertex v, float cost) {
    const std::uint32_t bucket = bucket_of(cost);
    QueueEntry& entry = entries_[v.index()];
    MESHER_ASSERT(cost >= 0.0F && entry.bucket == kNone);
    Ends& ends = ends_[bucket];
    entry.next = kNone;
    entry.previous = ends.last;
    entry.bucket = bucket;
    if (ends.last == kNone) {
      ends.first = v.index();
      occupied_[bucket / 64] |= std::uint64_t{1} << bucket % 64;
    } else {
      entries_[ends.last].next = v.index();
    }
    ends.last = v.index();
    if (bucket / 64 < lowest_word_) lowest_word_ = bucket / 64;
  }

  bool contains(Vertex v) const { return bucket(v) != kNone; }
  /// Returns the bucket of the vertex; kNone if it is not in a queue.
  std::uint32_t bucket(Vertex v) const { return entries_[v.index()].bucket; }

  void remove(Vertex v) {
    QueueEntry& entry = entries_[v.index()];
    if (entry.bucket == kNone) return;
    Ends& ends = ends_[entry.bucket];
    (entry.previous == kNone ? ends.first : entries_[entry.previous].next) = entry.next;
    (entry.next == kNone ? ends.last : entries_[entry.next].previous) = entry.previous;
    if (ends.first == kNone) {
      occupied_[entry.bucket / 64] &= ~(std::uint64_t{1} << entry.bucket % 64);
    }
    entry.bucket = kNone;
  }

  /// Returns the next vertex in the same bucket, or none. Pre: the queue contains `v`.
  Vertex behind(Vertex v) const { return Vertex(entries_[v.index()].next); }

  /// Returns the cheapest vertex, or none.
  Vertex front() {
    for (; lowest_word_ < occupied_.size(); ++lowest_word_) {
      const std::uint64_t word = occupied_[lowest_word_];
      if (word == 0) continue;
      return Vertex(
          ends_[lowest_word_ * 64 + static_cast<std::uint32_t>(std::countr_zero(word))].first);
    }
    return {};
  }

 private:
  struct Ends {
    std::uint32_t first = kNone;
    std::uint32_t last = kNone;
  };

  std::span<QueueEntry> entries_;
  std::vector<Ends> ends_;
  std::array<std::uint64_t, kBuckets / 64> occupied_{};
  std::uint32_t lowest_word_ = kBuckets / 64;
};

}  // namespace mesher::simplify
