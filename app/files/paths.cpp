#include "app/files/paths.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "engine/core/error.h"
#include "engine/io/extension.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

fs::path environment_path(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? fs::path() : fs::path(value);
}

fs::path pictures_folder() {
  const fs::path xdg = environment_path("XDG_PICTURES_DIR");
  if (is_folder(xdg)) return xdg;
  const fs::path home = environment_path("HOME");
  if (!home.empty() && is_folder(home / "Pictures")) return home / "Pictures";
  return ".";
}

/// The program's folder in the one that the variable names, or in that below the home folder.
fs::path own_folder(const char* variable, const char* below_home) {
  const fs::path folder = environment_path(variable);
  // The specification says that a relative path is to be ignored.
  if (folder.is_absolute()) return folder / "mesher";
  // Below a relative path, each working folder would have journals of its own.
  const fs::path home = environment_path("HOME");
  return home.is_absolute() ? home / below_home / "mesher" : fs::path();
}

}  // namespace

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return !path.empty() && fs::is_directory(path, ignored);
}

fs::path nearest_folder(const fs::path& folder) {
  fs::path nearest = folder;
  while (nearest.has_relative_path() && !is_folder(nearest))
    nearest = nearest.parent_path();
  return is_folder(nearest) ? nearest : fs::path(".");
}

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw OutputError(folder.string(), "cannot make the folder: " + failed.message());
}

fs::path find_model(const std::string& name) {
  if (is_there(name)) return name;
  if (fs::path(name).has_parent_path()) return name;
  const fs::path asset = samples_folder() / name;
  if (is_there(asset) && !is_folder(asset)) return asset;
  const fs::path with_extension = asset.string() + ".obj";
  return is_there(with_extension) ? with_extension : fs::path(name);
}

fs::path free_name(const fs::path& folder, const std::string& stem, const std::string& extension) {
  fs::path file = folder / (stem + extension);
  for (int i = 2; is_there(file); ++i) {
    file = folder / fmt::format("{}-{}{}", stem, i, extension);
  }
  return file;
}

fs::path free_picture_name(const fs::path& folder, const std::string& stem) {
  return free_name(folder, stem, ".png");
}

fs::path next_screenshot(const std::string& model_name) {
  return free_picture_name(pictures_folder(), "mesher-" + fs::path(model_name).stem().string());
}

fs::path state_folder() {
  return own_folder("XDG_STATE_HOME", ".local/state");
}

fs::path config_folder() {
  return own_folder("XDG_CONFIG_HOME", ".config");
}

fs::path home_folder() {
  return environment_path("HOME");
}

fs::path samples_folder() {
  static const fs::path kFolder = [] {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    const fs::path share = program.parent_path().parent_path() / "share/mesher/assets";
    // In a build folder, this is a link to the assets of the sources.
    const fs::path resolved = fs::canonical(share, ignored);
    return ignored ? share : resolved;
  }();
  return kFolder;
}

std::string time_text(fs::file_time_type time) {
  const auto system = std::chrono::file_clock::to_sys(time);
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(system));
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(seconds));
}

bool is_png_name(const fs::path& file) {
  return io::extension_of(file) == ".png";
}

bool is_webp_name(const fs::path& file) {
  return io::extension_of(file) == ".webp";
}

fs::path typed_path(std::string text) {
  constexpr const char* kAround = " \t\"'";
  const std::size_t first = text.find_first_not_of(kAround);
  if (first == std::string::npos) return {};
  text = text.substr(first, text.find_last_not_of(kAround) - first + 1);
  if (text == "~" || text.starts_with("~/")) {
    text.replace(0, 1, environment_path("HOME").string());
  }
  return text;
}

}  // namespace mesher::app
