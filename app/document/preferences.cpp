#include "app/document/preferences.h"

#include <algorithm>

#include "engine/io/pm_file.h"

namespace mesher::app {
namespace {

std::filesystem::path whole_path(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::path whole = std::filesystem::absolute(file, ignored);
  return whole.empty() ? file : whole.lexically_normal();
}

}  // namespace

void remember_opened(Preferences& preferences, const std::filesystem::path& file) {
  const std::filesystem::path whole = whole_path(file);
  // A pipe cannot be opened again.
  std::error_code ignored;
  if (std::filesystem::exists(whole, ignored) && !std::filesystem::is_regular_file(whole, ignored))
    return;
  std::vector<std::filesystem::path>& recent = preferences.recent;
  std::erase(recent, whole);
  recent.insert(recent.begin(), whole);
  recent.resize(std::min(recent.size(), Preferences::kMostRecent));
  preferences.open_folder = whole.parent_path();
}

void remember_saved(Preferences& preferences, const std::filesystem::path& file) {
  preferences.save_folder = whole_path(file).parent_path();
  // A progressive mesh is saved besides the model, and not in its place.
  if (!io::has_pm_ending(file)) preferences.save_extension = file.extension().string();
}

}  // namespace mesher::app
