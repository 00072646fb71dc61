#pragma once

#include <memory>

#include "app/document/document.h"
#include "app/document/edit_task.h"
#include "app/document/history.h"
#include "engine/mesh/shape.h"

namespace mesher::app {

/// An edit that replaces the shown model by another shape. The document keeps the difference in its
/// history, so that the edit can be undone.
class ModelEdit : public EditTask {
 public:
  /// Refuses in progressive mode, where the model is not shown; otherwise calls `prepare`. O(V +
  /// F): the model is copied.
  bool start(Document& document) override;
  bool changes_model() const override { return true; }
  /// Applies the difference to the model in place, so that the GPU receives only what changed. The
  /// camera stays. O(size of the difference).
  void finish(Document& document) override;

 protected:
  /// As `start`, of an edit that is allowed.
  virtual bool prepare(Document& document) = 0;
  /// Stores the outcome of the edit in the document, before the model changes.
  virtual void report(Document& document) = 0;
  /// Returns what the result's panel shows of the edit. Called after `report`.
  virtual EditOutcome outcome() const { return {}; }

  /// Copies the shown model. The first edit of a model also keeps that copy as the model as it was
  /// opened. O(V + F).
  void take_shown(Document& document);
  /// Records the change from the shown model to `shape`. O(V + F).
  void record(const Shape& shape, Progress* progress);

  std::shared_ptr<const Shape> shown_;
  Statistics statistics_;                      ///< of the shown model
  std::shared_ptr<const scene::Scene> scene_;  ///< as Model::scene
  Edit edit_;
};

/// Applies an edit to the model and keeps it in the history. An edit without `subdivision_after`
/// ends the subdivision, because its result is not a level of it. O(difference).
void record_edit(Document& document, Edit&& edit);

/// Undoes or redoes an edit of the history, and says so in the notice. O(difference).
void undo(Document& document);
void redo(Document& document);
/// Undoes or redoes until `steps` edits are done, or as near to that as edits are kept. O(the
/// differences).
void go_to_step(Document& document, std::size_t steps);

/// Reverts the last change, whose result cannot be shown: an edit is removed from the history, and
/// an undo is redone. Returns false if there is no change to revert. Pre: no edit is running, since
/// it would have started from that result. O(difference).
bool take_back_last_edit(Document& document);

/// Call after the model has changed. Clears the selection of edges unless the edit
/// `keeps_topology`. If it does, and the model is shown at the detail at which it was opened, later
/// simplifications start from the model as it is now. O(1); O(V + F) after a simplification.
void note_model_changed(Document& document, bool keeps_topology);

/// Returns whether progressive mode is on, in which the model cannot be edited. If so, the notice
/// says what to do.
bool refuse_in_progressive(Document& document);
/// The words of that refusal; null: the model can be edited.
const char* progressive_refusal(const Document& document);

/// A copy of the model that other threads can share. O(V + F).
std::shared_ptr<const Shape> copy_of(const Model& model);

}  // namespace mesher::app
