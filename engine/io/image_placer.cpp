#include "engine/io/image_placer.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/beside.h"
#include "engine/io/mapped_file.h"

namespace mesher::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFileNameBytes = 100;

/// Returns a file name without anything that a file system or an MTL could take for another.
std::string file_name_of(std::string_view text) {
  std::string name(text.substr(0, kMostFileNameBytes));
  for (char& c : name) {
    const bool is_control = static_cast<unsigned char>(c) < ' ' || c == '\x7F';
    if (is_control || std::string_view("/\\:*?\"<>|#").find(c) != std::string_view::npos) c = '_';
  }
  const std::size_t begin = name.find_first_not_of(" .-");
  const std::size_t end = name.find_last_not_of(" .");
  return begin == std::string::npos ? std::string() : name.substr(begin, end + 1 - begin);
}

std::string extension_of_type(std::string_view mime_type) {
  constexpr std::pair<std::string_view, const char*> kExtensions[] = {
      {"image/png", ".png"},   {"image/jpeg", ".jpg"},       {"image/webp", ".webp"},
      {"image/ktx2", ".ktx2"}, {"image/vnd-ms.dds", ".dds"},
  };
  const auto* found =
      std::ranges::find(kExtensions, mime_type, &std::pair<std::string_view, const char*>::first);
  return found == std::end(kExtensions) ? "" : found->second;
}

/// Returns the path of an image with slashes; empty if it leads out of the folder.
std::string relative_path(const fs::path& path) {
  std::string text = path.string();
  std::ranges::replace(text, '\\', '/');
  const fs::path normal = fs::path(text).lexically_normal();
  return stays_below(normal) && normal.has_filename() ? normal.generic_string() : std::string();
}

/// Returns a path with a number at the end of its name: "a/brick-2.png".
std::string numbered(const std::string& path, int number) {
  const fs::path whole(path);
  fs::path name = whole.stem();
  name += "-" + std::to_string(number);
  name += whole.extension();
  return (whole.parent_path() / name).generic_string();
}

bool holds(const fs::path& file, const std::string& bytes) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) != bytes.size()) return false;
  try {
    return MappedFile(file).bytes() == bytes;
  } catch (const InputError&) {
    return false;  // not readable: another file, as far as one can see
  }
}

}  // namespace

const std::string& ImagePlacer::place(std::uint32_t image, const std::string& usual_name) {
  const auto known = placed_.find(image);
  if (known != placed_.end()) return known->second;
  return placed_.emplace(image, find_place(materials_.images[image], usual_name)).first->second;
}

std::string ImagePlacer::find_place(const EncodedImage& image, const std::string& usual_name) {
  if (!image.bytes) return image.path.string();
  const std::string own = relative_path(image.path);
  std::string wanted = own;
  if (wanted.empty()) {
    wanted = file_name_of(image.name);
    if (wanted.empty()) wanted = file_name_of(usual_name);
    if (wanted.empty()) wanted = "texture";
    const std::string extension = extension_of_type(image.mime_type);
    if (!wanted.ends_with(extension)) wanted += extension;
  }
  std::string name = wanted;
  for (int number = 2; !take(name, *image.bytes); ++number)
    name = numbered(wanted, number);
  return name == own ? image.path.string() : name;
}

/// Returns whether a name is free or its file holds the image already, and takes it then.
bool ImagePlacer::take(const std::string& name, const std::string& bytes) {
  if (taken_.contains(name)) return false;
  const fs::path file = fs::path(main_.name()).parent_path() / name;
  std::error_code error;
  const bool exists = fs::exists(fs::symlink_status(file, error));
  if (exists && !holds(file, bytes)) return false;
  taken_.insert(name);
  if (!exists) main_.add_side(name).write(bytes);
  return true;
}

}  // namespace mesher::io
