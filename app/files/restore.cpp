#include "app/files/restore.h"

#include <utility>

#include "app/edit/edit_text.h"
#include "app/edit/edits.h"
#include "app/files/journal.h"
#include "engine/core/error.h"

namespace mesher::app {

void answer_lost(Session& session, LostAnswer answer) {
  LostEdits lost = std::move(session.lost.front());
  session.lost.pop_front();
  switch (answer) {
    case LostAnswer::restore:
      session.wants_restore.push_back(std::move(lost));
      break;
    case LostAnswer::discard:
      discard(std::move(lost));
      break;
    case LostAnswer::later:
      break;
  }
}

void request_lost_edits(Document& document, const LostEdits& lost) {
  document.edits.restored = lost;
  try {
    for (const std::string& text : lost.texts)
      request(document.edits, edit_from_text(text, document));
    for (std::size_t i = lost.done; i < lost.texts.size(); ++i)
      request_undo(document);
  } catch (const Error& error) {
    document.edits.waiting.clear();
    document.error = lost.journal.string() + ": " + error.what();
  }
}

}  // namespace mesher::app
