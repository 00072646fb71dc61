#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/document/subdivision.h"
#include "engine/mesh/delta.h"
#include "engine/mesh/model.h"
#include "engine/mesh/statistics.h"

namespace mesher::app {

/// An edit that can be undone and redone: the difference between two models, and the statistics of
/// both, which are therefore never recomputed.
struct Edit {
  std::string name;  ///< "simplify to 4,500 faces"
  /// The edit as text, from which it can be repeated (app/edit/edit_text.h).
  std::string text;
  MeshDelta mesh;
  AttributesDelta attributes;
  Statistics before;
  Statistics after;
  /// Number of the drag that made the edit; 0: none. The edits of one drag are one step of the
  /// history: each replaces the one before it (History::take_back).
  std::uint64_t drag = 0;
  /// The subdivision that the model was a level of, and the one that it is a level of now.
  std::optional<SubdivisionLevel> subdivision_before{};
  std::optional<SubdivisionLevel> subdivision_after{};

  bool changes_anything() const { return !mesh.is_empty() || !attributes.is_empty(); }
  std::size_t memory_bytes() const { return mesh.memory_bytes() + attributes.memory_bytes(); }
};

/// What is known of an edit for as long as the model is open, also when its difference was dropped.
struct HistoryStep {
  std::string name;
  std::string text;
  std::uint64_t id = 0;  ///< no other step of the history has it, not even one that was dropped
};

/// The edits of a model, done and undone. Beyond a memory limit the oldest edits are dropped, but
/// never the last one. Functions that run out of memory throw std::bad_alloc and leave both the
/// model and the history unchanged.
class History {
 public:
  static constexpr std::size_t kMemoryBudget = std::size_t{1} << 30U;

  History() = default;
  explicit History(std::size_t budget_bytes) : budget_bytes_(budget_bytes) {}

  /// Applies an edit and keeps it; drops the undone edits. Pre: the model is in the state from
  /// which the edit starts. O(size of the difference).
  void perform(Edit&& edit, Model& model, Statistics& statistics);
  /// Undoes the last edit. Pre: undo_depth() > 0, and the model is as the last call left it.
  void undo(Model& model, Statistics& statistics);
  /// As `undo`, but neither this edit nor those undone before it can be redone. Returns the edit.
  Edit take_back(Model& model, Statistics& statistics);
  /// Redoes the edit that was undone last. Pre: redo_depth() > 0; the same for the model.
  void redo(Model& model, Statistics& statistics);

  std::size_t undo_depth() const { return done_.size(); }
  std::size_t redo_depth() const { return undone_.size(); }
  /// The edits that `undo` and `redo` would undo and redo. Pre: there is one.
  const Edit& undo_edit() const { return done_.back(); }
  const Edit& redo_edit() const { return undone_.back(); }
  const std::string& undo_name() const { return steps_[done_steps_ - 1].name; }
  const std::string& redo_name() const { return steps_[done_steps_].name; }
  /// All edits since the model was opened, in order: first those done, then those undone. Their
  /// number may exceed `undo_depth() + redo_depth()`, because old edits cannot be undone any more.
  const std::vector<HistoryStep>& steps() const { return steps_; }
  std::size_t done_steps() const { return done_steps_; }
  /// The id of the last edit done; 0: the model is as it was opened. While the id is the same, so
  /// is the model.
  std::uint64_t state() const { return done_steps_ == 0 ? 0 : steps_[done_steps_ - 1].id; }
  std::size_t memory_bytes() const { return bytes_; }

 private:
  void forget_undone();

  std::size_t budget_bytes_ = kMemoryBudget;
  std::size_t bytes_ = 0;
  std::deque<Edit> done_;
  std::deque<Edit> undone_;  ///< the last undone edit is at the end
  std::vector<HistoryStep> steps_;
  std::size_t done_steps_ = 0;
  std::uint64_t last_id_ = 0;
};

}  // namespace mesher::app
