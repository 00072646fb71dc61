#include "app/viewer/desktop_files.h"

#include <utility>

#include "app/files/browse.h"
#include "app/files/open.h"
#include "app/files/save.h"

namespace mesher::app {

bool DesktopFiles::advance() {
  bool is_changed = false;
  if (const std::optional<DialogAnswer> answer = desktop_.take()) {
    accept(*answer);
    is_changed = true;
  }
  return replace_open_dialog() || replace_save_dialog() || is_changed;
}

bool DesktopFiles::replace_open_dialog() {
  OpenDialog& own = session_.open_dialog;
  if (!own.is_shown || !own.opening.empty() || !desktop_.is_available()) return false;
  own.is_shown = false;
  if (desktop_.is_open()) return true;
  is_saving_ = false;
  desktop_.open({.title = "Open models", .filters = model_filters(), .folder = own.browser.folder},
                true);
  return true;
}

bool DesktopFiles::replace_save_dialog() {
  Saving& own = session_.saving;
  if (!own.shows_dialog || !desktop_.is_available()) return false;
  own.shows_dialog = false;
  if (desktop_.is_open()) return true;
  is_saving_ = true;
  saving_ = own;
  desktop_.save(
      {.title = "Save the model", .filters = model_filters(), .folder = own.browser.folder},
      own.browser.typed);
  return true;
}

void DesktopFiles::accept(const DialogAnswer& answer) {
  switch (answer.outcome) {
    case DialogOutcome::canceled:
      return;
    case DialogOutcome::refused:
      session_.document.error = answer.problem;
      return;
    case DialogOutcome::failed:
      return show_own_dialog();
    case DialogOutcome::chosen:
      break;
  }
  if (!is_saving_) {
    for (const std::filesystem::path& file : answer.files)
      request_open(session_, file);
    return;
  }
  Saving& saving = session_.saving;
  saving.then = saving_.then;
  set_text(saving.browser, with_format(answer.files.front(), saving_.browser.typed).string());
  // The desktop has asked whether to overwrite the file.
  saving.asked = typed_file(saving.browser);
  submit_save(saving, session_.document);
  session_.document.error = saving.browser.problem;
}

void DesktopFiles::show_own_dialog() {
  if (is_saving_) {
    session_.saving = std::move(saving_);
    session_.saving.shows_dialog = true;
  } else {
    show_open_dialog(session_);
  }
}

}  // namespace mesher::app
