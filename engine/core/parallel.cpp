#include "engine/core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>

namespace mesher {

unsigned thread_count() {
  const auto limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<unsigned>(std::max<std::size_t>(
      1, std::min<std::size_t>(limit, tbb::this_task_arena::max_concurrency())));
}

ThreadLimit::ThreadLimit(unsigned count)
    : control_(count == 0
                   ? nullptr
                   : new tbb::global_control(tbb::global_control::max_allowed_parallelism, count)) {
}

ThreadLimit::~ThreadLimit() {
  delete static_cast<tbb::global_control*>(control_);
}

void parallel_for(std::size_t n, std::size_t grain, const std::function<void(IndexRange)>& body) {
  if (n == 0) return;
  if (n <= grain || thread_count() == 1) return body({0, n});
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain),
                    [&](const tbb::blocked_range<std::size_t>& r) {
                      body({r.begin(), r.end()});
                    });
}

void parallel_chunks(std::size_t n, std::size_t chunk,
                     const std::function<void(std::size_t, IndexRange)>& body) {
  const std::size_t chunks = chunk_count(n, chunk);
  const auto run = [&](std::size_t i) { body(i, {i * chunk, std::min(n, (i + 1) * chunk)}); };
  if (chunks <= 1 || thread_count() == 1) {
    for (std::size_t i = 0; i < chunks; ++i)
      run(i);
    return;
  }
  tbb::parallel_for(std::size_t{0}, chunks, run);
}

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
