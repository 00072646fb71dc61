#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "engine/core/progress.h"

namespace mesher {

/// Returns the number of threads that parallel loops may use now, at least 1.
unsigned thread_count();

/// Limits every parallel loop of the process to `count` threads while the object lives. 0: no
/// additional limit.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned count);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// A half-open range of indices.
struct IndexRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t size() const { return end - begin; }
};

/// Runs `body(range)` in parallel over chunks that together cover [0, n) exactly once, in
/// unspecified order. Chunks hold about `grain` indices or more. Results must not depend on the
/// chunk boundaries.
void parallel_for(std::size_t n, std::size_t grain, const std::function<void(IndexRange)>& body);

/// Runs `body(i)` in parallel once per index below `n`, in unspecified order, in chunks of about
/// `grain`.
template <class Body>
void parallel_for_each(std::size_t n, std::size_t grain, const Body& body) {
  parallel_for(n, grain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      body(static_cast<std::uint32_t>(i));
  });
}

/// Splits [0, n) into chunks of `chunk` indices (the last may be shorter) regardless of the thread
/// count, and runs `body(chunk_index, range)` for each in parallel. Use it when partial results are
/// combined in chunk order, so that the result is the same for any number of threads.
void parallel_chunks(std::size_t n, std::size_t chunk,
                     const std::function<void(std::size_t, IndexRange)>& body);

/// The same, but reports the finished indices after each chunk, as the current stage of `progress`,
/// and throws Cancelled soon after a cancellation. `progress` may be null.
void parallel_chunks(std::size_t n, std::size_t chunk, Progress* progress,
                     const std::function<void(std::size_t, IndexRange)>& body);

/// Runs `body(range)` on this thread for consecutive chunks of `chunk` indices in increasing order,
/// reports progress before each chunk, and throws Cancelled soon after a cancellation. `progress`
/// may be null. The loop over a chunk stays free of checks.
template <class Body>
void ordered_chunks(std::size_t n, std::size_t chunk, Progress* progress, const Body& body) {
  for (std::size_t begin = 0; begin < n; begin += chunk) {
    report(progress, static_cast<float>(begin) / static_cast<float>(n));
    body(IndexRange{begin, std::min(n, begin + chunk)});
  }
}

/// Returns the number of chunks that parallel_chunks makes.
constexpr std::size_t chunk_count(std::size_t n, std::size_t chunk) {
  return (n + chunk - 1) / chunk;
}

/// Returns the sum of `map(range)` over fixed chunks, added in chunk order, so that floating-point
/// sums are deterministic too. Reports as parallel_chunks does; `progress` may be null.
template <class T, class Map>
T parallel_sum(std::size_t n, std::size_t chunk, Progress* progress, Map&& map) {
  std::vector<T> partial(chunk_count(n, chunk));
  parallel_chunks(n, chunk, progress,
                  [&](std::size_t i, IndexRange range) { partial[i] = map(range); });
  T total{};
  for (const T& part : partial)
    total += part;
  return total;
}

/// The same without progress.
template <class T, class Map>
T parallel_sum(std::size_t n, std::size_t chunk, Map&& map) {
  return parallel_sum<T>(n, chunk, nullptr, std::forward<Map>(map));
}

}  // namespace mesher
