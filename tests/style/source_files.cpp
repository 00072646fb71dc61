#include "tests/style/source_files.h"

#include <algorithm>
#include <fstream>

namespace mesher {
namespace {

namespace fs = std::filesystem;

SourceFile read(const fs::path& root, const fs::path& file) {
  SourceFile source{fs::relative(file, root).generic_string(), {}};
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    source.lines.push_back(line);
  return source;
}

}  // namespace

std::vector<SourceFile> source_files(const std::vector<std::string_view>& folders,
                                     const std::vector<std::string_view>& extensions) {
  const fs::path root = MESHER_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (const std::string_view folder : folders) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (entry.is_regular_file() && std::ranges::find(extensions, extension) != extensions.end()) {
        files.push_back(read(root, entry.path()));
      }
    }
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

std::string included(std::string_view line) {
  const auto skip_blanks = [&] {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  };
  skip_blanks();
  if (!line.starts_with('#')) return {};
  line.remove_prefix(1);
  skip_blanks();
  if (!line.starts_with("include")) return {};
  line.remove_prefix(7);
  skip_blanks();
  const std::size_t end = line.find_first_of(">\"", 1);
  return end == std::string_view::npos ? std::string{} : std::string(line.substr(0, end + 1));
}

}  // namespace mesher
