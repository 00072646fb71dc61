#pragma once

#include <memory>

#include "app/edits.h"
#include "app/job.h"
#include "app/session.h"

namespace mesher::app {

/// Runs the edits that a session waits for, one after the other, each simplification and
/// subdivision in the background: keys pressed meanwhile queue up.
class EditRunner {
 public:
  /// `wake` as for Job.
  EditRunner(Session& session, void (*wake)()) : session_(session), wake_(wake) {}

  /// Takes what is done into the session and starts what comes next. Returns whether anything
  /// happened that is to be seen.
  bool advance();
  bool is_running() const { return job_ != nullptr; }
  /// What runs, or null.
  const Job* job() const { return job_.get(); }
  /// Ends what runs, with a notice, and forgets what waits.
  void cancel();
  /// The same, silently, and done when it returns: the model goes.
  void stop();
  /// Ends what runs, silently: its model has gone. What waits is the next one's.
  void drop() { job_.reset(); }
  /// Returns when nothing runs or waits any more.
  void finish();

 private:
  void start();
  void take();

  Session& session_;
  void (*wake_)();
  std::unique_ptr<JobOf<EditResult>> job_;
};

}  // namespace mesher::app
