#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/document/model_source.h"

namespace mesher::app {

/// The unsaved edits of a process that ended without a word, as its journal holds them
/// (app/files/journal.h).
struct LostEdits {
  std::filesystem::path journal;
  std::filesystem::path file;  ///< that the model was read from
  ModelSource source;
  std::vector<std::string> names;  ///< of all edits, for people
  std::vector<std::string> texts;  ///< of all edits, from which they can be repeated
  std::size_t done = 0;            ///< number of edits that were not undone
  std::string ended;               ///< when the journal was last written: "2026-11-29 14:02"
  std::string problem;             ///< why they cannot be repeated; empty: they can
  /// While it exists, no other process offers the same edits.
  std::shared_ptr<void> lock;
};

}  // namespace mesher::app
