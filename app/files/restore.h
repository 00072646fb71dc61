#pragma once

#include "app/document/lost_edits.h"
#include "app/document/session.h"

namespace mesher::app {

/// The answers to the question what to do with lost edits.
enum class LostAnswer {
  restore,  ///< open the file and repeat the edits
  discard,  ///< remove the journal
  later,    ///< ask again at the next start
};
/// Pre: there are lost edits, and for `restore` they have no problem.
void answer_lost(Session& session, LostAnswer answer);

/// Requests the edits, and the undos that followed them. Call when the model of `lost` is shown. If
/// a text is damaged, requests nothing and sets the document's error.
void request_lost_edits(Document& document, const LostEdits& lost);

}  // namespace mesher::app
