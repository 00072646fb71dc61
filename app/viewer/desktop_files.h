#pragma once

#include "app/document/session.h"
#include "app/files/desktop_dialog.h"

namespace mesher::app {

/// Shows the desktop's dialogs of files in place of the program's own, where the desktop has some.
class DesktopFiles {
 public:
  /// `wake`: see Job.
  DesktopFiles(Session& session, void (*wake)()) : session_(session), desktop_(wake) {}

  /// Replaces a dialog that the session asks for, and takes the answer of one that has ended. If
  /// the desktop fails, shows the program's dialog. Call after each event. Returns whether anything
  /// has changed.
  bool advance();

 private:
  bool replace_open_dialog();
  bool replace_save_dialog();
  void accept(const DialogAnswer& answer);
  void show_own_dialog();

  Session& session_;
  DesktopDialog desktop_;
  bool is_saving_ = false;
  Saving saving_;  ///< the dialog that was replaced
};

}  // namespace mesher::app
