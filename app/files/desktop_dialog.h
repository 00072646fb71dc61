#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "app/files/file_dialog.h"
#include "engine/core/job.h"

// GLib's type, without its headers.
struct _GCancellable;

namespace mesher::app {

struct PortalQuestion;

/// The file dialogs of the desktop, through xdg-desktop-portal, one at a time. A thread waits for
/// the desktop, so that no function below blocks the window. Use it from one thread.
class DesktopDialog {
 public:
  /// Starts to look for the portal. `wake`: see Job; called when an answer can be taken.
  explicit DesktopDialog(void (*wake)());
  /// Closes the dialog.
  ~DesktopDialog();
  DesktopDialog(const DesktopDialog&) = delete;
  DesktopDialog& operator=(const DesktopDialog&) = delete;

  /// Returns whether the desktop has file dialogs. Returns false if there is no session bus, or if
  /// it or the portal have not answered so far. Waits for them in the first 200 ms after the
  /// construction only. False from the time that a dialog has failed.
  bool is_available();

  /// Shows a dialog to choose one or several files that exist. Before version 4, portals ignore the
  /// folder. Pre: !is_open().
  void open(FileDialog dialog, bool allows_several);
  /// Shows a dialog to name a file. `suggested_name` has no folder. The desktop asks whether to
  /// overwrite a file, so the caller need not. The name may lack an extension. Pre: !is_open().
  void save(FileDialog dialog, std::string suggested_name);

  /// Returns whether a dialog is shown, or has ended and its answer was not taken.
  bool is_open() const { return asking_ != nullptr; }
  /// Returns the answer, once, when the dialog has ended.
  std::optional<DialogAnswer> take();
  /// Closes the dialog, if one is shown, without an answer. Returns within some 50 ms.
  void close();

 private:
  void ask(PortalQuestion question);

  std::string address_;  ///< of the session bus; empty: none
  void (*wake_)();
  std::chrono::steady_clock::time_point answer_by_;  ///< until when `is_available` waits
  bool has_failed_ = false;
  std::shared_ptr<_GCancellable> stop_probe_;
  std::shared_future<bool> probe_;  ///< invalid: no bus
  std::shared_ptr<_GCancellable> stop_;
  std::unique_ptr<JobOf<DialogAnswer>> asking_;
};

}  // namespace mesher::app
