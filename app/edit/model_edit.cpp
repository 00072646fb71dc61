#include "app/edit/model_edit.h"

#include <algorithm>
#include <string>
#include <utility>

#include "app/edit/progressive_edits.h"
#include "app/edit/subdivide_edit.h"

namespace mesher::app {
namespace {

/// Times of finding the difference to the model before, and of the statistics.
constexpr double kRecordWeights[] = {0.4, 0.6};

/// Returns whether the meshes differ in nothing but sharpness.
bool has_same_surface(const Mesh& a, const Mesh& b) {
  return std::ranges::equal(a.origins(), b.origins()) && std::ranges::equal(a.twins(), b.twins()) &&
         std::ranges::equal(a.positions(), b.positions());
}

/// Call after an edit of the history was undone or redone. Allocates nothing, so that a step is
/// made as a whole or not at all.
void note_history_step(Document& document, std::string&& notice, const Edit& edit, bool is_undo) {
  document.notice = std::move(notice);
  document.edits.subdivision = is_undo ? edit.subdivision_before : edit.subdivision_after;
  document.edits.was_undone = is_undo;
  note_model_changed(document, edit.mesh.keeps_topology());
  follow_shown_level(document.edits, document.subdivide);
}

/// An edit that changes nothing reports on the model that is there.
void note_outcome(Edits& edits, const EditOutcome& outcome) {
  if (!outcome.simplification && !outcome.subdivision) return;
  EditOutcome& kept = edits.outcomes[edits.history.state()];
  if (outcome.simplification) kept.simplification = outcome.simplification;
  if (outcome.subdivision) kept.subdivision = outcome.subdivision;
}

}  // namespace

bool ModelEdit::start(Document& document) {
  if (refuse_in_progressive(document)) {
    follow_shown_level(document.edits, document.subdivide);
    return false;
  }
  return prepare(document);
}

void ModelEdit::finish(Document& document) {
  // The mode may have been turned on while the edit was running.
  const bool was_progressive = document.progressive.is_on();
  report(document);
  if (edit_.changes_anything()) record_edit(document, std::move(edit_));
  note_outcome(document.edits, outcome());
  if (was_progressive) leave_progressive(document);
  follow_shown_level(document.edits, document.subdivide);
}

void ModelEdit::take_shown(Document& document) {
  Edits& edits = document.edits;
  shown_ = copy_of(document.model);
  if (!edits.opened) edits.opened = shown_;
  statistics_ = document.statistics;
  scene_ = document.model.scene;
}

void ModelEdit::record(const Shape& shape, Progress* progress) {
  begin_stage(progress, "recording");
  Stages stages(progress, kRecordWeights);
  stages.next();
  {
    Stages parts(progress, {0.9, 0.1});
    parts.next();
    edit_.mesh = difference(shown_->mesh, shape.mesh, progress);
    parts.next();
    edit_.attributes = difference(shown_->attributes, shape.attributes, progress);
  }
  edit_.before = statistics_;
  stages.next();
  edit_.after = scene::statistics(shape.mesh, shape.attributes, scene_.get(), progress);
}

void record_edit(Document& document, Edit&& edit) {
  edit.subdivision_before = document.edits.subdivision;
  const bool keeps_topology = edit.mesh.keeps_topology();
  History& history = document.edits.history;
  const std::uint64_t before = history.state();
  history.perform(std::move(edit), document.model, document.statistics);
  // The undone edits are gone.
  auto& outcomes = document.edits.outcomes;
  outcomes.erase(outcomes.upper_bound(before), outcomes.end());
  document.edits.subdivision = history.undo_edit().subdivision_after;
  document.edits.was_undone = false;
  note_model_changed(document, keeps_topology);
}

void undo(Document& document) {
  History& history = document.edits.history;
  if (history.undo_depth() == 0) {
    document.notice = "nothing to undo";
    return;
  }
  std::string notice = "undone: " + history.undo_name();
  history.undo(document.model, document.statistics);
  note_history_step(document, std::move(notice), history.redo_edit(), true);
}

void redo(Document& document) {
  History& history = document.edits.history;
  if (history.redo_depth() == 0) {
    document.notice = "nothing to redo";
    return;
  }
  std::string notice = "redone: " + history.redo_name();
  history.redo(document.model, document.statistics);
  note_history_step(document, std::move(notice), history.undo_edit(), false);
}

void go_to_step(Document& document, std::size_t steps) {
  const History& history = document.edits.history;
  while (history.done_steps() > steps && history.undo_depth() > 0)
    undo(document);
  while (history.done_steps() < steps && history.redo_depth() > 0)
    redo(document);
}

bool take_back_last_edit(Document& document) {
  History& history = document.edits.history;
  if (document.edits.was_undone && history.redo_depth() > 0) {
    redo(document);
    document.edits.was_undone = true;  // the next call redoes the undo before this one
    return true;
  }
  if (history.undo_depth() == 0) return false;
  const Edit taken_back = history.take_back(document.model, document.statistics);
  document.edits.outcomes.erase(document.edits.outcomes.upper_bound(history.state()),
                                document.edits.outcomes.end());
  document.edits.subdivision = taken_back.subdivision_before;
  note_model_changed(document, taken_back.mesh.keeps_topology());
  follow_shown_level(document.edits, document.subdivide);
  return true;
}

void note_model_changed(Document& document, bool keeps_topology) {
  Edits& edits = document.edits;
  ++edits.revision;
  forget_progressive(document);
  if (!keeps_topology) return document.creases.forget_edges();
  if (edits.opened && has_same_surface(edits.opened->mesh, document.model.mesh)) {
    edits.opened.reset();
  }
}

const char* progressive_refusal(const Document& document) {
  return document.progressive.is_on()
             ? "progressive mode shows a level of detail: press P to leave it, or K to use this "
               "level as the model"
             : nullptr;
}

bool refuse_in_progressive(Document& document) {
  const char* reason = progressive_refusal(document);
  if (reason != nullptr) document.notice = reason;
  return reason != nullptr;
}

std::shared_ptr<const Shape> copy_of(const Model& model) {
  return std::make_shared<const Shape>(Shape{model.mesh, model.attributes});
}

}  // namespace mesher::app
