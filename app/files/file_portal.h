#pragma once

#include <gio/gio.h>

#include <string>

#include "app/files/file_dialog.h"

namespace mesher::app {

/// What the desktop is asked to show.
struct PortalQuestion {
  FileDialog dialog;
  bool saves = false;
  bool allows_several = false;   ///< when opening
  std::string suggested_name{};  ///< when saving
};

/// Returns whether the desktop shows file dialogs: whether org.freedesktop.portal.Desktop on the
/// bus of this address has the interface FileChooser. The bus may start the portal for it. Returns
/// when the portal answers, after some 30 seconds, or soon after `stop` is canceled.
bool has_file_portal(const std::string& address, GCancellable* stop);

/// Shows a dialog of the desktop and waits until it is closed. Canceling `stop` closes it; the
/// function then returns within some 50 ms, even if the portal or the bus do not answer. Uses no
/// state outside the call, so that any thread may call it.
DialogAnswer ask_file_portal(const std::string& address, const PortalQuestion& question,
                             GCancellable* stop);

}  // namespace mesher::app
