#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace mesher {

class Progress;

/// Number of threads that parallel loops may use now (at least 1).
unsigned thread_count();

/// Limits every parallel loop of the process to `count` threads (0: as many as the machine has)
/// for as long as the object lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned count);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Half-open range of indices.
struct IndexRange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t size() const { return end - begin; }
};

/// Runs `body(range)` over chunks that cover [0, n) once, in parallel, in no particular order.
/// Chunks hold about `grain` indices or more. Results must not depend on how [0, n) is cut.
void parallel_for(std::size_t n, std::size_t grain, const std::function<void(IndexRange)>& body);

/// Runs `body(i)` once for every index below `n`, in parallel, in no particular order, about
/// `grain` of them at a time.
template <class Body>
void parallel_for_each(std::size_t n, std::size_t grain, const Body& body) {
  parallel_for(n, grain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      body(static_cast<std::uint32_t>(i));
  });
}

/// Cuts [0, n) into chunks of `chunk` indices (the last may be shorter), whatever the thread
/// count, and runs `body(chunk_index, range)` for each in parallel. For work whose partial results
/// are then combined in chunk order, so that the outcome is the same for any number of threads.
void parallel_chunks(std::size_t n, std::size_t chunk,
                     const std::function<void(std::size_t, IndexRange)>& body);

/// The same where somebody may be watching: notes how far it has come before each chunk, and throws
/// Cancelled soon after that is asked for.
void parallel_chunks(std::size_t n, std::size_t chunk, Progress* progress,
                     const std::function<void(std::size_t, IndexRange)>& body);

/// Number of chunks that parallel_chunks makes.
constexpr std::size_t chunk_count(std::size_t n, std::size_t chunk) {
  return (n + chunk - 1) / chunk;
}

/// Sum of `map(range)` over fixed chunks, added in chunk order: deterministic for floats too.
template <class T, class Map>
T parallel_sum(std::size_t n, std::size_t chunk, Map&& map) {
  std::vector<T> partial(chunk_count(n, chunk));
  parallel_chunks(n, chunk, [&](std::size_t i, IndexRange range) { partial[i] = map(range); });
  T total{};
  for (const T& part : partial)
    total += part;
  return total;
}

}  // namespace mesher
