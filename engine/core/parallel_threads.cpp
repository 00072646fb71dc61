// The parallel loops without TBB, for ThreadSanitizer: it sees every synchronization of
// std::thread, and none of an uninstrumented library.
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "engine/core/parallel.h"

namespace mesher {
namespace {

/// More than some machines have cores: a race needs two threads that run at the same time, and more
/// find it sooner.
constexpr unsigned kThreads = 4;

std::mutex limits_mutex;
std::multiset<unsigned> limits;

/// Loops within loops run on their own thread.
thread_local bool is_within_loop = false;

void run_all(std::size_t count, const std::function<void(std::size_t)>& run) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    const bool was_within = std::exchange(is_within_loop, true);
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        run(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
    is_within_loop = was_within;
  };
  std::vector<std::thread> helpers;
  for (std::size_t i = 1; i < std::min<std::size_t>(thread_count(), count); ++i)
    helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers)
    helper.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

unsigned thread_count() {
  const std::lock_guard lock(limits_mutex);
  if (is_within_loop) return 1;
  return limits.empty() ? kThreads : std::min(kThreads, *limits.begin());
}

ThreadLimit::ThreadLimit(unsigned count) : control_(count == 0 ? nullptr : new unsigned(count)) {
  if (count == 0) return;
  const std::lock_guard lock(limits_mutex);
  limits.insert(count);
}

ThreadLimit::~ThreadLimit() {
  const auto* const count = static_cast<unsigned*>(control_);
  if (count == nullptr) return;
  const std::lock_guard lock(limits_mutex);
  limits.erase(limits.find(*count));
  delete count;
}

void parallel_for(std::size_t n, std::size_t grain, const std::function<void(IndexRange)>& body) {
  const std::size_t chunk = std::max<std::size_t>(grain, 1);
  run_all(chunk_count(n, chunk), [&](std::size_t i) {
    body({i * chunk, std::min(n, (i + 1) * chunk)});
  });
}

void parallel_chunks(std::size_t n, std::size_t chunk,
                     const std::function<void(std::size_t, IndexRange)>& body) {
  run_all(chunk_count(n, chunk), [&](std::size_t i) {
    body(i, {i * chunk, std::min(n, (i + 1) * chunk)});
  });
}

}  // namespace mesher
