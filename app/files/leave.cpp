#include "app/files/leave.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "app/document/tabs.h"
#include "app/edit/progressive_edits.h"

namespace mesher::app {
namespace {

/// Returns whether the shown model can be left; otherwise the notice says why not.
bool can_close(Document& document) {
  if (!document.progressive.is_arriving()) return true;
  document.notice = tab_refusal(document);
  return false;
}

std::optional<std::size_t> unsaved_tab(const Session& session) {
  for (std::size_t i = 0; i < tab_count(session); ++i) {
    if (has_unsaved_edits(document_of(session, i))) return i;
  }
  return std::nullopt;
}

void ask(Session& session, Leaving leaving) {
  session.open_dialog.is_shown = false;
  session.saving.shows_dialog = false;
  session.unsaved = leaving;
}

/// Closes the shown model, whose edits are saved or discarded.
void close(Session& session) {
  if (can_close(session.document)) close_shown_tab(session);
}

void quit(Session& session) {
  const std::optional<std::size_t> unsaved = unsaved_tab(session);
  if (!unsaved) {
    session.wants_quit = true;
  } else if (can_close(session.document)) {
    show_tab(session, *unsaved);
    ask(session, Leaving::quit);
  }
}

}  // namespace

void request_leave(Session& session, Leaving leaving) {
  if (has_unsaved_edits(session.document)) return ask(session, leaving);
  if (leaving == Leaving::close) {
    close(session);
  } else {
    quit(session);
  }
}

void answer_leave(Session& session, LeaveAnswer answer) {
  const Leaving leaving = *std::exchange(session.unsaved, std::nullopt);
  switch (answer) {
    case LeaveAnswer::save:
      // Otherwise the shown level would be saved in place of the edited model.
      leave_progressive(session.document);
      open_save_dialog(session.saving, session.document, session.preferences);
      session.saving.then = leaving;
      break;
    case LeaveAnswer::discard:
      close(session);
      // The edits of other models may be unsaved, too.
      if (leaving == Leaving::quit) quit(session);
      break;
    case LeaveAnswer::cancel:
      break;
  }
}

void note_saved(Session& session, const Saved& saved) {
  session.document.notice = notice_of(saved);
  remember_saved(session.preferences, saved.file);
  Document* document = document_opened_as(session, saved.opening);
  if (document == nullptr) return;  // it was closed meanwhile
  if (saved.state && saved.losses.empty()) document->edits.saved_state = *saved.state;
  const bool leaves = saved.then == Leaving::quit || document == &session.document;
  // Edits that the file cannot hold, or that came after it, would be lost: ask once more.
  if (saved.then && leaves) request_leave(session, *saved.then);
}

void run_waiting_save(Session& session) {
  if (const auto task = begin_save(session.saving, session.document)) {
    note_saved(session, perform(*task));
  }
}

}  // namespace mesher::app
