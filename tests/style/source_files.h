#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mesher {

/// A text file of the repository.
struct SourceFile {
  std::string path;  ///< from the repository's root, with forward slashes
  std::vector<std::string> lines;
};

/// The files below the given top-level folders that have one of the extensions (".h", ".cpp"),
/// sorted by path.
std::vector<SourceFile> source_files(const std::vector<std::string_view>& folders,
                                     const std::vector<std::string_view>& extensions);

/// Returns the file that a line includes, with its quotes or brackets: "\"engine/mesh/mesh.h\"".
/// Empty: the line is no include.
std::string included(std::string_view line);

}  // namespace mesher
