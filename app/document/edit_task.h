#pragma once

#include <string>

#include "engine/core/progress.h"

namespace mesher::app {

struct Document;

/// An edit that was requested: simplify, subdivide, undo, and so on. The viewer or the script runs
/// the requested edits in order (app/edit/edits.h). To add one, derive from this class or, for an
/// edit of the model, from ModelEdit (app/edit/model_edit.h).
class EditTask {
 public:
  EditTask() = default;
  virtual ~EditTask() = default;
  EditTask(const EditTask&) = delete;
  EditTask& operator=(const EditTask&) = delete;

  /// Copies from the document everything that `perform` needs. Returns whether there is something
  /// to perform: a small edit is finished here, and a refused one sets the document's notice. Runs
  /// on the main thread. Throws std::bad_alloc.
  virtual bool start(Document& document) = 0;
  /// Does the work; may run on another thread and touches no document. Throws Cancelled.
  virtual void perform(Progress* progress) = 0;
  /// Puts the result into the document. Runs on the main thread, after `perform`.
  virtual void finish(Document& document) = 0;

  /// Whether it is an edit of the model, which would be lost with it.
  virtual bool changes_model() const { return false; }

  /// Shown while it runs: "Simplifying to 4,500 faces". Valid after `start`.
  const std::string& title() const { return title_; }

 protected:
  std::string title_;
};

}  // namespace mesher::app
