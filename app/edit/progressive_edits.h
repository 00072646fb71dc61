#pragma once

#include <memory>

#include "app/document/document.h"
#include "app/document/edit_task.h"
#include "app/document/progressive_view.h"
#include "app/edit/edit_words.h"

namespace mesher::app {

/// Turns progressive mode on or off. In this mode the window shows a progressive mesh of the model,
/// which itself does not change and cannot be edited. The progressive mesh is kept until the model
/// changes; if there is none, it is requested.
void toggle_progressive(Document& document);
/// Turns the mode on, and requests missing geomorphs. Pre: there is a progressive mesh.
void enter_progressive(Document& document);
void leave_progressive(Document& document);
/// Drops the progressive mesh. Call when the model has changed.
void forget_progressive(Document& document);

/// Returns how a progressive mesh of the model is built, by the current rules.
simplify::SimplifyOptions progressive_options(const Document& document);
/// Rebuilds the progressive mesh by the current rules.
void request_rebuilt_progressive(Document& document);
/// Requests the geomorphs that a progressive mesh from a file lacks.
void request_geomorph(Document& document);
/// The edit that `words` describe: "keep_level splits=N", of the progressive mesh that was read
/// from a file, or "keep_level splits=N base-faces=N", with rules of simplification, of one that is
/// built for the purpose. Throws UsageError.
std::unique_ptr<EditTask> keep_level_edit(EditWords& words, const Document& document);
/// Uses the shown level as the model. This is an edit that can be undone.
void request_keep_level(Document& document);

}  // namespace mesher::app
