#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace mesher::app {

/// The files that a dialog is about.
enum class FileKind { models, pictures };

enum class FolderOrder { name, size, modified };

/// Which entries of a folder are shown, and in which order.
struct FolderFilter {
  std::string part;  ///< names contain it, in upper or lower case
  bool shows_hidden = false;
  bool shows_all_files = false;  ///< otherwise only those of the kind
  FileKind kind = FileKind::models;
  FolderOrder order = FolderOrder::name;
  bool is_descending = false;
};

/// The part of a dialog that finds a file. One text is a name, a path or a search: the list shows
/// the folder of the typed path and, to open a file, only the names that contain what follows the
/// last slash.
struct FileBrowser {
  std::filesystem::path folder;  ///< names that are typed are in it
  std::string typed;
  bool searches = false;          ///< typing filters the list
  FolderFilter filter;            ///< of the list
  std::optional<int> row;         ///< of the list, chosen by the mouse or arrow keys
  bool wants_completion = false;  ///< the Tab key was pressed
  std::string problem;            ///< what went wrong with the typed file
  /// Increases when the program sets the text. The text field then takes the new text.
  std::uint32_t texts_set = 0;
};

/// The dialog that opens a file. It stays until the file was read.
struct OpenDialog {
  bool is_shown = false;
  FileBrowser browser;
  std::filesystem::path opening;  ///< the file that is being read; empty: none
};

}  // namespace mesher::app
