#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/document/lost_edits.h"
#include "app/document/session.h"
#include "app/files/journal.h"
#include "engine/core/job.h"

namespace mesher::app {

/// Keeps the unsaved edits of all open models on disk, and finds those that earlier runs left.
class EditKeeper {
 public:
  /// What a person should know.
  struct Remarks {
    std::string problem;  ///< edits are at risk
    std::string notice;
  };

  /// `folder`: of the journals; empty: nothing is kept.
  explicit EditKeeper(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes what has changed. Only the shown document changes, but writing the journal of another
  /// one may have failed before.
  Remarks keep(Session& session);
  /// Returns whether a journal could not be written. `keep` tries again after
  /// Journal::kRetrySeconds.
  bool is_failing() const;
  /// Returns whether edits are kept for the next start.
  bool has_edits() const;
  /// Removes the journals, at an orderly end.
  void forget();

  /// Starts to look for edits of earlier runs, whose models' files may be large. Calls `wake` when
  /// they are found.
  void look_for_lost_edits(void (*wake)());
  /// Adds the edits that were found to the session. Returns whether the search has ended just now.
  bool take_lost_edits(Session& session);

 private:
  std::filesystem::path folder_;
  std::map<std::uint64_t, Journal> journals_;  ///< by Document::opening
  std::unique_ptr<JobOf<std::vector<LostEdits>>> search_;
};

}  // namespace mesher::app
