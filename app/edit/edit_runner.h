#pragma once

#include <memory>

#include "app/document/document.h"
#include "app/document/edit_task.h"
#include "engine/core/job.h"

namespace mesher::app {

/// Runs the requested edits of a document in order, and long ones on another thread. Edits that are
/// requested meanwhile are queued.
class EditRunner {
 public:
  /// `wake` as for Job.
  EditRunner(Document& document, void (*wake)()) : document_(document), wake_(wake) {}

  /// Puts a finished edit into the document and starts the next one. Returns whether anything has
  /// changed that a person can see.
  bool advance();
  bool is_running() const { return job_ != nullptr; }
  /// The running edit, or null.
  const Job* job() const { return job_.get(); }
  /// Cancels the running edit, with a notice, and drops the requested ones.
  void cancel();
  /// As `cancel`, without a notice. Returns when the edit has ended. Call before the model is
  /// replaced.
  void stop();
  /// Ends the running edit without a notice. Call after its model was replaced. The requested edits
  /// are kept, because they are meant for the new model.
  void drop() { job_.reset(); }
  /// Returns when no edit is running or requested.
  void finish();

 private:
  using EditJob = JobOf<std::shared_ptr<EditTask>>;

  void start();
  void take();

  Document& document_;
  void (*wake_)();
  std::unique_ptr<EditJob> job_;
};

}  // namespace mesher::app
