#pragma once

#include <cstdint>
#include <memory>

#include "app/document/document.h"
#include "app/document/edit_task.h"
#include "app/edit/crease_edits.h"

namespace mesher::app {

/// Adds an edit to those that the viewer or the script runs next. The edit keeps the current rules,
/// because those of the document may change before it runs.
void request(Edits& edits, std::unique_ptr<EditTask> task);

/// Removes about 10 % of the faces, and at least one edge.
void request_remove_tenth(Document& document);
/// Collapses one edge.
void request_collapse_edge(Document& document);
/// Simplifies the model as it was opened, so that detail can also be restored. `faces`: 0: as far
/// as the largest error allows, which then is set.
void request_simplify_to(Document& document, std::uint32_t faces);
/// Subdivides once more.
void request_subdivide(Document& document);
/// Returns to the previous level, down to the model that was subdivided.
void request_previous_level(Document& document);
/// Rebuilds the shown level by the current rules.
void request_same_level(Document& document);
/// Changes the sharpness of edges.
std::unique_ptr<EditTask> crease_edit(const CreaseRequest& crease_request);
void request_crease_edit(Document& document, const CreaseRequest& crease_request);
void request_undo(Document& document);
void request_redo(Document& document);
/// Goes to the model after the first `steps` edits of the history, by undo and redo.
void request_history_step(Document& document, std::size_t steps);

/// Starts the first requested edit. Returns it if there is something to perform; null if it is
/// finished or refused. Pre: an edit is requested.
std::unique_ptr<EditTask> start_next_edit(Document& document);

/// Runs all requested edits, on this thread.
void run_waiting_edits(Document& document);

}  // namespace mesher::app
