#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "app/document/subdivision.h"
#include "engine/mesh/delta.h"
#include "engine/mesh/model.h"
#include "engine/mesh/statistics.h"

namespace mesher::app {

/// An edit that can be undone and redone: the difference between two models, and the statistics of
/// both, so that neither direction has to count again.
struct Edit {
  std::string name;  ///< "simplify to 4,500 faces"
  MeshDelta mesh;
  AttributesDelta attributes;
  Statistics before;
  Statistics after;
  /// What is dragged makes many edits that are to be one step: they have the number of the drag,
  /// and each takes the place of the one before (History::take_back). 0: no drag made it.
  std::uint64_t drag = 0;
  /// Of what the model was a level, and is now.
  std::optional<SubdivisionLevel> subdivision_before{};
  std::optional<SubdivisionLevel> subdivision_after{};

  bool changes_anything() const { return !mesh.is_empty() || !attributes.is_empty(); }
  std::size_t memory_bytes() const { return mesh.memory_bytes() + attributes.memory_bytes(); }
};

/// The edits of a model, done and undone. Past a limit of memory the oldest are forgotten, though
/// never the last one. What needs more memory than there is throws std::bad_alloc, and neither the
/// model nor the history has changed then.
class History {
 public:
  static constexpr std::size_t kMemoryBudget = std::size_t{1} << 30U;

  History() = default;
  explicit History(std::size_t budget_bytes) : budget_bytes_(budget_bytes) {}

  /// Does an edit and keeps it; what was undone before is forgotten. Pre: the model is in the state
  /// from which the edit starts. O(what it changes).
  void perform(Edit&& edit, Model& model, Statistics& statistics);
  /// Takes the last edit back. Pre: undo_depth() > 0, and the model is as the last call left it.
  void undo(Model& model, Statistics& statistics);
  /// The same, for good: neither it nor what was undone before can be done again. Returns the edit.
  Edit take_back(Model& model, Statistics& statistics);
  /// Does the edit again that was undone last. Pre: redo_depth() > 0, the same.
  void redo(Model& model, Statistics& statistics);

  std::size_t undo_depth() const { return done_.size(); }
  std::size_t redo_depth() const { return undone_.size(); }
  /// What undo would take back, and redo would do. Pre: there is one.
  const Edit& undo_edit() const { return done_.back(); }
  const Edit& redo_edit() const { return undone_.back(); }
  const std::string& undo_name() const { return undo_edit().name; }
  const std::string& redo_name() const { return redo_edit().name; }
  std::size_t memory_bytes() const { return bytes_; }

 private:
  void forget_undone();

  std::size_t budget_bytes_ = kMemoryBudget;
  std::size_t bytes_ = 0;
  std::deque<Edit> done_;
  std::deque<Edit> undone_;  ///< the last undone at the end
};

}  // namespace mesher::app
