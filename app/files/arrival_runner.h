#pragma once

#include <filesystem>
#include <memory>

#include "app/document/session.h"
#include "app/edit/edit_runner.h"
#include "app/files/pm_arrival.h"

namespace mesher::app {

/// Loads progressive meshes into a session while it is shown, one at a time. Failures become the
/// document's error; the part that was loaded stays.
class ArrivalRunner {
 public:
  /// `wake` as for ByteStream. `edits`: those of the session. While one is running, no new model is
  /// shown.
  ArrivalRunner(Session& session, const EditRunner& edits, void (*wake)())
      : session_(session), edits_(edits), wake_(wake) {}

  /// Continues an arrival that was started elsewhere; may be null.
  void take_over(std::unique_ptr<PmArrival> arrival);
  /// Starts to load a file. The shown model stays until the base is loaded, which gets a tab. Never
  /// blocks. Throws InputError if the file cannot be opened; nothing changes then.
  void open(const std::filesystem::path& file);
  /// Reads for about `seconds`. Returns whether the picture changes.
  bool advance(double seconds);
  /// Returns when everything is loaded. Throws as PmArrival::finish.
  void finish();
  /// Stops loading; the part that was loaded becomes the whole mesh.
  void stop();

  bool is_running() const { return arrival_ != nullptr; }
  /// Returns whether a regular file is loading, which ends by itself.
  bool is_busy() const;
  /// Returns whether `advance` has something to do.
  bool has_news() const;

 private:
  bool must_wait() const;

  Session& session_;
  const EditRunner& edits_;
  void (*wake_)();
  std::unique_ptr<PmArrival> arrival_;
};

}  // namespace mesher::app
