#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace mesher::io {

/// Returns whether a path stays in or below the folder that it is relative to.
bool stays_below(const std::filesystem::path& path);

/// What was found of a file that another file names.
struct Beside {
  std::filesystem::path file;      ///< to be opened; empty: there is no such file
  std::filesystem::path relative;  ///< the same from the folder
  bool is_outside = false;         ///< not found, and the name leads out of the folder
  bool is_address = false;         ///< not found, and the name is an address: "http://..."

  /// Returns why a file that was not found is not read, for messages: "there is no such file".
  std::string_view reason() const;
};

/// Looks for a regular file in or below `folder` under several spellings of its name. Other files
/// are not opened: a stranger wrote the names, and the disk is the user's.
Beside find_beside(const std::filesystem::path& folder,
                   std::initializer_list<std::string> spellings);

/// Looks for a file by its name as it is, and with backslashes as slashes.
Beside find_named_beside(const std::filesystem::path& folder, std::string_view name);

/// Looks for the file of a URI. Programs that do not escape names write "10%.bin": where the
/// decoded name is malformed or names no file, the URI is tried as it is.
Beside find_uri_beside(const std::filesystem::path& folder, std::string_view uri);

}  // namespace mesher::io
