#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>

#include "app/document/edit_task.h"
#include "app/document/history.h"
#include "app/document/lost_edits.h"
#include "app/document/simplification.h"
#include "app/document/subdivision.h"
#include "engine/mesh/shape.h"

namespace mesher::app {

/// What an edit reported, for the results that panels show.
struct EditOutcome {
  std::optional<SimplifyOutcome> simplification;
  std::optional<SubdivideOutcome> subdivision;
};

/// The edits of the shown model: those done, and those requested.
struct Edits {
  History history;
  /// The model as it was opened, with the creases that were added at that level of detail; null:
  /// the model is shown as it was opened.
  std::shared_ptr<const Shape> opened;
  std::uint32_t opened_faces = 0;
  double opened_diagonal = 0.0;  ///< errors are in percent of it, also after edits
  /// Of the last simplification and the last subdivision, also if they were undone.
  std::optional<SimplifyOutcome> last;
  std::optional<SubdivideOutcome> last_subdivision;
  /// What was reported of the models of the history, by History::state.
  std::map<std::uint64_t, EditOutcome> outcomes;
  /// The subdivision that the model is a level of; none: no coarser level is kept.
  std::optional<SubdivisionLevel> subdivision;
  /// Requested edits, which the viewer or the script runs in this order.
  std::deque<std::unique_ptr<EditTask>> waiting;
  /// Lost edits that were requested again; their journal is still there.
  std::optional<LostEdits> restored;
  /// A requested edit that changes the model is running.
  bool is_changing = false;
  bool was_undone = false;  ///< the last change was an undo
  /// History::state of the model that was saved last; 0: as it was opened.
  std::uint64_t saved_state = 0;
  /// Increases with every change of the model, so that data derived from it can be checked.
  std::uint64_t revision = 0;

  /// Returns the report of the simplification that the shown model is the result of; null: it is
  /// not the result of one. Likewise of a subdivision.
  const SimplifyOutcome* simplification_outcome() const {
    const auto found = outcomes.find(history.state());
    return found != outcomes.end() && found->second.simplification ? &*found->second.simplification
                                                                   : nullptr;
  }
  const SubdivideOutcome* subdivision_outcome() const {
    const auto found = outcomes.find(history.state());
    return found != outcomes.end() && found->second.subdivision ? &*found->second.subdivision
                                                                : nullptr;
  }
};

}  // namespace mesher::app
