#include "engine/core/job.h"

#include <new>

#include "engine/core/assert.h"
#include "engine/core/error.h"
#include "engine/core/memory.h"

namespace mesher {

Job::Job(std::string title, std::function<void(Progress&)> work, void (*wake)())
    : title_(std::move(title)),
      thread_([this, work = std::move(work), wake]() mutable { run(std::move(work), wake); }) {}

Job::~Job() {
  cancel();
  wait();
}

void Job::wait() {
  if (thread_.joinable()) thread_.join();
}

bool Job::wait_for(double seconds) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!is_done() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return is_done();
}

double Job::age_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void Job::run(std::function<void(Progress&)> work, void (*wake)()) {
  try {
    work(progress_);
    progress_.set(1.0F);
  } catch (const std::bad_alloc&) {
    try {
      throw_out_of_memory(title_);
    } catch (...) {
      failure_ = std::current_exception();
    }
  } catch (...) {
    failure_ = std::current_exception();
  }
  work = nullptr;  // freeing large meshes takes time: not where the job is displayed
  is_done_.store(true, std::memory_order_release);
  if (wake != nullptr) wake();
}

void Job::rethrow_failure() const {
  MESHER_ASSERT(is_done());
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace mesher
