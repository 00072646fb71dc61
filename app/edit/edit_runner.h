#pragma once

#include <cstdint>
#include <memory>

#include "app/document/document.h"
#include "app/document/edit_task.h"
#include "engine/core/canceled_jobs.h"
#include "engine/core/job.h"

namespace mesher::app {

/// Runs the requested edits of a document in order, and long ones on another thread. Edits that are
/// requested meanwhile are queued.
class EditRunner {
 public:
  /// `wake` as for Job.
  EditRunner(Document& document, void (*wake)()) : document_(document), wake_(wake) {}

  /// Puts a finished edit into the document and starts the next one. An edit whose model is not
  /// shown any more is dropped. Returns whether anything has
  /// changed that a person can see.
  bool advance();
  bool is_running() const { return job_ != nullptr; }
  /// The running edit, or null.
  const Job* job() const { return job_.get(); }
  /// Cancels the running edit, with a notice, and drops the requested ones. Returns at once.
  void cancel();
  /// As `cancel`, without a notice. Returns when the edit has ended.
  void stop();
  /// Returns when no edit is running or requested.
  void finish();

 private:
  using EditJob = JobOf<std::shared_ptr<EditTask>>;

  void start();
  void take();
  bool drop_foreign_job();

  Document& document_;
  void (*wake_)();
  std::unique_ptr<EditJob> job_;
  CanceledJobs canceled_;
  bool was_canceled_ = false;  ///< since the last `advance`
  std::uint64_t job_of_ = 0;   ///< Document::opening of the model that the job edits
};

}  // namespace mesher::app
