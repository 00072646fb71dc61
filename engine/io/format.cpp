#include "engine/io/format.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

namespace mesher {

std::optional<Format> format_of(const std::filesystem::path& file) {
  static constexpr std::pair<std::string_view, Format> kExtensions[] = {
      {".obj", Format::obj}, {".ply", Format::ply},   {".stl", Format::stl},
      {".off", Format::off}, {".gltf", Format::gltf}, {".glb", Format::glb}};
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [name, format] : kExtensions) {
    if (extension == name) return format;
  }
  return std::nullopt;
}

}  // namespace mesher
