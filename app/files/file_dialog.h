#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mesher::app {

/// A row in the list of file types of a dialog: "Stanford PLY", with the pattern "*.ply".
struct FileFilter {
  std::string name;
  std::vector<std::string> patterns;  ///< shell patterns; compare them without case
};

/// Returns the filters for opening and saving: all models, each format, all files.
std::vector<FileFilter> model_filters();

/// What a dialog that asks for files shows.
struct FileDialog {
  std::string title;
  std::vector<FileFilter> filters;  ///< the first is selected
  std::filesystem::path folder{};   ///< where the dialog starts; empty: the dialog decides
  /// The window above which the dialog stays: "x11:" and the window's ID in hexadecimal, or empty.
  std::string parent{};
};

enum class DialogOutcome {
  chosen,
  canceled,
  refused,  ///< the dialog worked, but the chosen file cannot be used; ask again
  failed,   ///< the dialog could not be shown, or ended without an answer; use another dialog
};

/// How a dialog ended.
struct DialogAnswer {
  DialogOutcome outcome = DialogOutcome::canceled;
  std::vector<std::filesystem::path> files{};  ///< absolute; at least one if the outcome is chosen
  std::string problem{};                       ///< why, if the outcome is refused or failed
};

}  // namespace mesher::app
