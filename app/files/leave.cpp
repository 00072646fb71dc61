#include "app/files/leave.h"

#include <utility>

#include "app/edit/progressive_edits.h"

namespace mesher::app {
namespace {

void leave(Session& session, const Leaving& leaving) {
  if (leaving.file.empty()) {
    session.wants_quit = true;
  } else {
    session.wants_open = leaving.file;
  }
}

}  // namespace

void request_leave(Session& session, const Leaving& leaving) {
  if (!has_unsaved_edits(session.document)) return leave(session, leaving);
  session.shows_open_dialog = false;
  session.saving.shows_dialog = false;
  session.unsaved = leaving;
}

void answer_leave(Session& session, LeaveAnswer answer) {
  const Leaving leaving = *std::exchange(session.unsaved, std::nullopt);
  switch (answer) {
    case LeaveAnswer::save:
      // Otherwise the shown level would be saved in place of the edited model.
      leave_progressive(session.document);
      open_save_dialog(session.saving, session.document);
      session.saving.then = leaving;
      break;
    case LeaveAnswer::discard:
      leave(session, leaving);
      break;
    case LeaveAnswer::cancel:
      break;
  }
}

void note_saved(Session& session, const Saved& saved) {
  Document& document = session.document;
  document.notice = notice_of(saved);
  if (saved.opening != document.opening) return;  // another model is shown by now
  if (saved.state && saved.losses.empty()) document.edits.saved_state = *saved.state;
  if (!saved.then) return;
  // Edits that the file cannot hold, or that came after it, would be lost: ask once more.
  request_leave(session, *saved.then);
}

void run_waiting_save(Session& session) {
  if (const auto task = begin_save(session.saving, session.document)) {
    note_saved(session, perform(*task));
  }
}

}  // namespace mesher::app
