#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/document/file_browser.h"
#include "app/files/folder.h"

namespace mesher::app {

/// Returns the folder that the list shows: that of the typed path.
std::filesystem::path shown_folder(const FileBrowser& browser);
/// Returns the path that is typed; empty: none.
std::filesystem::path typed_file(const FileBrowser& browser);

/// Call when the text was edited: filters the list.
void follow_text(FileBrowser& browser);
/// Says what is wrong with the text, and keeps it.
void refuse_text(FileBrowser& browser, const std::string& problem);
/// Sets the text, without a change of the list.
void set_text(FileBrowser& browser, const std::string& text);
/// Shows another folder, and clears the text.
void go_to(FileBrowser& browser, const std::filesystem::path& folder);
/// Goes to a folder of the list, or types the name of a file.
void choose(FileBrowser& browser, const FolderEntry& entry);
/// Chooses the row that is so many rows below; stays in the list.
void move_row(FileBrowser& browser, int rows, std::size_t count);
/// Returns a typed text, completed as far as all names of the list that begin so agree. The only
/// folder that begins so gets a slash.
std::string completed_text(const std::string& typed, const std::vector<const FolderEntry*>& shown);

/// If a row is chosen, goes to its folder or types its name. Returns whether it was a folder.
bool take_row(FileBrowser& browser, const std::vector<const FolderEntry*>& shown);

/// Returns a question if the file exists and is not the one in `asked`, which it becomes; else an
/// empty text.
std::string overwrite_question(std::filesystem::path& asked, const std::filesystem::path& file);

/// Handles Enter: returns the chosen row or, without one, the typed file, a model that comes with
/// the program, or the only file that the list shows. Goes to a folder instead. Returns none and
/// sets the problem if there is no such file.
std::optional<std::filesystem::path> submit(FileBrowser& browser,
                                            const std::vector<const FolderEntry*>& shown);

}  // namespace mesher::app
