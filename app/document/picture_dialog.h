#pragma once

#include <filesystem>
#include <optional>

#include "app/document/file_browser.h"
#include "app/document/picture_options.h"

namespace mesher::app {

/// The dialog that writes a picture or a turntable, and the file that it was told to write.
struct PictureDialog {
  bool is_shown = false;
  FileBrowser browser;
  PictureOptions options;
  bool is_turn = false;  ///< a turntable instead of a still picture
  TurntableOptions turn;
  std::filesystem::path asked;  ///< an existing file: submitting it once more overwrites it
  /// The file to write next. The viewer writes it.
  std::optional<std::filesystem::path> waiting;
};

}  // namespace mesher::app
