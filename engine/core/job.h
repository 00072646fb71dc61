#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "engine/core/progress.h"

namespace mesher {

/// Work on its own thread, as seen by the code that displays it. The destructor cancels the work
/// and waits for the thread.
class Job {
 public:
  virtual ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  const std::string& title() const { return title_; }  ///< "Opening bunny.obj"
  const Progress& progress() const { return progress_; }
  /// As Progress::cancel.
  bool cancel() { return progress_.cancel(); }
  bool is_done() const { return is_done_.load(std::memory_order_acquire); }
  /// Waits until the job is done.
  void wait();
  /// Waits until the job is done, for at most `seconds`. Returns whether it is done.
  bool wait_for(double seconds) const;
  /// Returns the seconds since the job began.
  double age_s() const;

 protected:
  /// Starts `work` on a new thread. The thread calls `wake` when the result is ready, so `wake`
  /// must be thread-safe; it may be null.
  Job(std::string title, std::function<void(Progress&)> work, void (*wake)());

  /// Throws the exception that the work threw, if any. Pre: is_done().
  void rethrow_failure() const;

 private:
  void run(std::function<void(Progress&)> work, void (*wake)());

  std::string title_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Progress progress_;
  std::exception_ptr failure_;
  std::atomic<bool> is_done_{false};
  std::thread thread_;
};

/// A job whose result is a T.
template <class T>
class JobOf : public Job {
 public:
  using Work = std::function<T(Progress&)>;

  JobOf(std::string title, Work work, void (*wake)())
      : JobOf(std::move(title), std::move(work), wake, std::make_shared<std::optional<T>>()) {}

  /// Returns the result, or throws the exception that the work threw (Cancelled among others). Pre:
  /// is_done(); called at most once.
  T take() {
    rethrow_failure();
    return std::move(**result_);
  }

 private:
  // The thread shares ownership of the result, because it may outlive this part of the object.
  JobOf(std::string title, Work work, void (*wake)(), std::shared_ptr<std::optional<T>> result)
      : Job(
            std::move(title),
            [work = std::move(work), result](Progress& progress) {
              T made = work(progress);
              check_cancelled(
                  &progress);  // frees what was made here, and not where it is displayed
              *result = std::move(made);
            },
            wake),
        result_(std::move(result)) {}

  std::shared_ptr<std::optional<T>> result_;
};

}  // namespace mesher
