#pragma once

#include <filesystem>
#include <optional>

#include "app/document/file_browser.h"
#include "app/document/leaving.h"

namespace mesher::app {

/// The dialog that saves the shown model, and the file that it was told to write.
struct Saving {
  bool shows_dialog = false;
  FileBrowser browser;          ///< its problem: why the model has not been saved yet
  std::filesystem::path asked;  ///< an existing file: submitting it once more overwrites it
  std::optional<Leaving> then;  ///< done once the file is written
  /// The file to write next. The viewer or the script writes it.
  std::optional<std::filesystem::path> waiting;
};

}  // namespace mesher::app
