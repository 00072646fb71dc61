#pragma once

#include <string>

#include "engine/core/progress.h"

namespace mesher::app {

struct Session;

/// An edit that was requested: simplify, subdivide, undo, and so on. The viewer or the script runs
/// the requested edits in order (app/edit/edits.h). To add one, derive from this class or, for an
/// edit of the model, from ModelEdit (app/edit/model_edit.h).
class EditTask {
 public:
  EditTask() = default;
  virtual ~EditTask() = default;
  EditTask(const EditTask&) = delete;
  EditTask& operator=(const EditTask&) = delete;

  /// Copies from the session everything that `perform` needs. Returns whether there is something to
  /// perform: a small edit is finished here, and a refused one sets the session's notice. Runs on
  /// the main thread. Throws std::bad_alloc.
  virtual bool start(Session& session) = 0;
  /// Does the work; may run on another thread and touches no session. Throws Cancelled.
  virtual void perform(Progress* progress) = 0;
  /// Puts the result into the session. Runs on the main thread, after `perform`.
  virtual void finish(Session& session) = 0;

  /// Shown while it runs: "Simplifying to 4,500 faces". Valid after `start`.
  const std::string& title() const { return title_; }

 protected:
  std::string title_;
};

}  // namespace mesher::app
