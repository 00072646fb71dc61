#include "app/files/file_dialog.h"

#include "engine/io/format.h"

namespace mesher::app {
namespace {

std::vector<FileFilter> filters_of(bool (*includes)(const io::FormatInfo&)) {
  std::vector<FileFilter> filters{{.name = "All models", .patterns = {}}};
  for (const io::FormatInfo& format : io::formats()) {
    if (!includes(format)) continue;
    const std::string pattern = std::string("*") + format.extension;
    filters.front().patterns.push_back(pattern);
    filters.push_back({.name = format.name, .patterns = {pattern}});
  }
  filters.push_back({.name = "All files", .patterns = {"*"}});
  return filters;
}

}  // namespace

std::vector<FileFilter> readable_filters() {
  return filters_of([](const io::FormatInfo&) { return true; });
}

std::vector<FileFilter> writable_filters() {
  return filters_of([](const io::FormatInfo& format) { return format.write != nullptr; });
}

}  // namespace mesher::app
