#include "app/edit/model_edit.h"

#include <algorithm>
#include <string>
#include <utility>

#include "app/edit/progressive_edits.h"
#include "app/edit/subdivide_edit.h"

namespace mesher::app {
namespace {

/// Returns whether the meshes differ in nothing but sharpness.
bool has_same_surface(const Mesh& a, const Mesh& b) {
  return std::ranges::equal(a.origins(), b.origins()) && std::ranges::equal(a.twins(), b.twins()) &&
         std::ranges::equal(a.positions(), b.positions());
}

}  // namespace

bool ModelEdit::start(Session& session) {
  if (refuse_in_progressive(session)) {
    follow_shown_level(session.edits, session.subdivide);
    return false;
  }
  return prepare(session);
}

void ModelEdit::finish(Session& session) {
  // The mode may have been turned on while the edit was running.
  const bool was_progressive = session.progressive.is_on();
  report(session);
  if (edit_.changes_anything()) record_edit(session, std::move(edit_));
  if (was_progressive) leave_progressive(session);
  follow_shown_level(session.edits, session.subdivide);
}

void ModelEdit::take_shown(Session& session) {
  Edits& edits = session.edits;
  shown_ = copy_of(session.model);
  if (!edits.opened) edits.opened = shown_;
  statistics_ = session.statistics;
}

void ModelEdit::record(const Shape& shape) {
  edit_.mesh = difference(shown_->mesh, shape.mesh);
  edit_.attributes = difference(shown_->attributes, shape.attributes);
  edit_.before = statistics_;
  edit_.after = statistics(shape.mesh);
}

void record_edit(Session& session, Edit&& edit) {
  edit.subdivision_before = session.edits.subdivision;
  const bool keeps_topology = edit.mesh.keeps_topology();
  History& history = session.edits.history;
  history.perform(std::move(edit), session.model, session.statistics);
  session.edits.subdivision = history.undo_edit().subdivision_after;
  session.edits.was_undone = false;
  note_model_changed(session, keeps_topology);
}

void undo(Session& session) {
  History& history = session.edits.history;
  if (history.undo_depth() == 0) {
    session.notice = "nothing to undo";
    return;
  }
  std::string notice = "undone: " + history.undo_name();
  const bool keeps_topology = history.undo_edit().mesh.keeps_topology();
  history.undo(session.model, session.statistics);
  session.notice = std::move(notice);
  session.edits.subdivision = history.redo_edit().subdivision_before;
  session.edits.was_undone = true;
  note_model_changed(session, keeps_topology);
  follow_shown_level(session.edits, session.subdivide);
}

void redo(Session& session) {
  History& history = session.edits.history;
  if (history.redo_depth() == 0) {
    session.notice = "nothing to redo";
    return;
  }
  std::string notice = "redone: " + history.redo_name();
  const bool keeps_topology = history.redo_edit().mesh.keeps_topology();
  history.redo(session.model, session.statistics);
  session.notice = std::move(notice);
  session.edits.subdivision = history.undo_edit().subdivision_after;
  session.edits.was_undone = false;
  note_model_changed(session, keeps_topology);
  follow_shown_level(session.edits, session.subdivide);
}

bool take_back_last_edit(Session& session) {
  History& history = session.edits.history;
  if (session.edits.was_undone && history.redo_depth() > 0) {
    redo(session);
    session.edits.was_undone = true;  // the next call redoes the undo before this one
    return true;
  }
  if (history.undo_depth() == 0) return false;
  const Edit taken_back = history.take_back(session.model, session.statistics);
  session.edits.subdivision = taken_back.subdivision_before;
  note_model_changed(session, taken_back.mesh.keeps_topology());
  follow_shown_level(session.edits, session.subdivide);
  return true;
}

void note_model_changed(Session& session, bool keeps_topology) {
  Edits& edits = session.edits;
  ++edits.revision;
  forget_progressive(session);
  if (!keeps_topology) return session.creases.forget_edges();
  if (edits.opened && has_same_surface(edits.opened->mesh, session.model.mesh)) {
    edits.opened.reset();
  }
}

bool refuse_in_progressive(Session& session) {
  if (!session.progressive.is_on()) return false;
  session.notice =
      "progressive mode shows a level of detail: press P to leave it, or K to use this level as "
      "the model";
  return true;
}

std::shared_ptr<const Shape> copy_of(const Model& model) {
  return std::make_shared<const Shape>(Shape{model.mesh, model.attributes});
}

}  // namespace mesher::app
