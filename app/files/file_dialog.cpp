#include "app/files/file_dialog.h"

#include "engine/io/format.h"

namespace mesher::app {
std::vector<FileFilter> model_filters() {
  std::vector<FileFilter> filters{{.name = "All models", .patterns = {}}};
  for (const io::FormatInfo& format : io::formats()) {
    const std::string pattern = std::string("*") + format.extension;
    filters.front().patterns.push_back(pattern);
    filters.push_back({.name = format.name, .patterns = {pattern}});
  }
  filters.push_back({.name = "All files", .patterns = {"*"}});
  return filters;
}

}  // namespace mesher::app
