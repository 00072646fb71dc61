#pragma once

#include <filesystem>
#include <memory>

#include "app/document/session.h"
#include "app/edit/edit_runner.h"
#include "app/files/pm_arrival.h"

namespace mesher::app {

/// Lets progressive meshes arrive in a session while it is looked at, one at a time. What goes
/// wrong is the session's error; what has come stays.
class ArrivalRunner {
 public:
  /// `wake` as for ByteStream. `edits`: the session's, which end when their model goes.
  ArrivalRunner(Session& session, EditRunner& edits, void (*wake)())
      : session_(session), edits_(edits), wake_(wake) {}

  /// Goes on with one that has begun elsewhere.
  void take_over(std::unique_ptr<PmArrival> arrival);
  /// What is shown stays until the base has arrived. Never waits. Returns whether it begins; where
  /// it does not, all is as it was.
  bool open(const std::filesystem::path& file);
  /// Reads on for about so many seconds. Returns whether there is anything new to see.
  bool advance(double seconds);
  /// Returns when all has arrived. Throws as PmArrival::finish.
  void finish();
  /// What has arrived is all that comes.
  void stop();

  bool is_running() const { return arrival_ != nullptr; }
  /// There is something for `advance` to do.
  bool has_news() const;

 private:
  Session& session_;
  EditRunner& edits_;
  void (*wake_)();
  std::unique_ptr<PmArrival> arrival_;
};

}  // namespace mesher::app
