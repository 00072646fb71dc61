#include "engine/core/parallel.h"

#include <atomic>

namespace mesher {

void parallel_chunks(std::size_t n, std::size_t chunk, Progress* progress,
                     const std::function<void(std::size_t, IndexRange)>& body) {
  if (progress == nullptr) {
    return parallel_chunks(n, chunk, [&](std::size_t i, IndexRange range) {
      check_cancelled(nullptr);  // after the end of a TimeLimit
      body(i, range);
    });
  }
  std::atomic<std::size_t> done{0};
  parallel_chunks(n, chunk, [&](std::size_t i, IndexRange range) {
    check_cancelled(progress);
    body(i, range);
    const std::size_t before = done.fetch_add(range.size(), std::memory_order_relaxed);
    progress->set(static_cast<float>(before + range.size()) / static_cast<float>(n));
  });
}

}  // namespace mesher
