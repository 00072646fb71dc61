#include "app/document/history.h"

#include <utility>

#include "engine/core/assert.h"

namespace mesher::app {
namespace {

// Attributes go first, because the names of their groups still need memory: if that fails, nothing
// has changed.
void apply(const Edit& edit, Model& model, Statistics& statistics) {
  make_room(model.mesh, edit.mesh);
  mesher::apply(model.attributes, edit.attributes);
  mesher::apply(model.mesh, edit.mesh);
  statistics = edit.after;
}

void revert(const Edit& edit, Model& model, Statistics& statistics) {
  make_room(model.mesh, edit.mesh);
  mesher::revert(model.attributes, edit.attributes);
  mesher::revert(model.mesh, edit.mesh);
  statistics = edit.before;
}

/// Makes `change`, then adds the edit. If the change fails or memory runs out, nothing is added.
template <class Change>
void add_after(std::deque<Edit>& edits, Edit& edit, Change&& change) {
  edits.emplace_back();
  try {
    change();
  } catch (...) {
    edits.pop_back();
    throw;
  }
  edits.back() = std::move(edit);
}

}  // namespace

void History::perform(Edit&& edit, Model& model, Statistics& statistics) {
  steps_.reserve(done_steps_ + 1);
  HistoryStep step{edit.name, edit.text, last_id_ + 1};
  add_after(done_, edit, [&] { apply(edit, model, statistics); });
  forget_undone();
  steps_.push_back(std::move(step));
  ++done_steps_;
  ++last_id_;
  bytes_ += done_.back().memory_bytes();
  while (bytes_ > budget_bytes_ && done_.size() > 1) {
    bytes_ -= done_.front().memory_bytes();
    done_.pop_front();
  }
}

void History::forget_undone() {
  for (const Edit& undone : undone_)
    bytes_ -= undone.memory_bytes();
  undone_.clear();
  steps_.resize(done_steps_);
}

void History::undo(Model& model, Statistics& statistics) {
  MESHER_ASSERT(undo_depth() > 0);
  add_after(undone_, done_.back(), [&] { revert(done_.back(), model, statistics); });
  done_.pop_back();
  --done_steps_;
}

Edit History::take_back(Model& model, Statistics& statistics) {
  undo(model, statistics);
  Edit edit = std::move(undone_.back());
  undone_.pop_back();
  bytes_ -= edit.memory_bytes();
  forget_undone();
  return edit;
}

void History::redo(Model& model, Statistics& statistics) {
  MESHER_ASSERT(redo_depth() > 0);
  add_after(done_, undone_.back(), [&] { apply(undone_.back(), model, statistics); });
  undone_.pop_back();
  ++done_steps_;
}

}  // namespace mesher::app
