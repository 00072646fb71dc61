#include "app/history.h"

#include <utility>

#include "engine/core/assert.h"

namespace mesher::app {
namespace {

void apply(const Edit& edit, Model& model, Statistics& statistics) {
  mesher::apply(model.mesh, edit.mesh);
  mesher::apply(model.attributes, edit.attributes);
  statistics = edit.after;
}

void revert(const Edit& edit, Model& model, Statistics& statistics) {
  mesher::revert(model.mesh, edit.mesh);
  mesher::revert(model.attributes, edit.attributes);
  statistics = edit.before;
}

}  // namespace

void History::perform(Edit&& edit, Model& model, Statistics& statistics) {
  apply(edit, model, statistics);
  for (const Edit& undone : undone_)
    bytes_ -= undone.memory_bytes();
  undone_.clear();
  bytes_ += edit.memory_bytes();
  done_.push_back(std::move(edit));
  while (bytes_ > budget_bytes_ && done_.size() > 1) {
    bytes_ -= done_.front().memory_bytes();
    done_.pop_front();
  }
}

void History::undo(Model& model, Statistics& statistics) {
  MESHER_ASSERT(undo_depth() > 0);
  revert(done_.back(), model, statistics);
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
}

void History::take_back(Model& model, Statistics& statistics) {
  undo(model, statistics);
  bytes_ -= undone_.back().memory_bytes();
  undone_.pop_back();
}

void History::redo(Model& model, Statistics& statistics) {
  MESHER_ASSERT(redo_depth() > 0);
  apply(undone_.back(), model, statistics);
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
}

}  // namespace mesher::app
