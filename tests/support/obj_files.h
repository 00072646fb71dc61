#pragma once

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "engine/mesh/build/soup.h"

namespace mesher::test {

/// Returns the OBJ files of a folder, sorted by name; none if the folder does not exist.
inline std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".obj") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Returns the soup as the text of an OBJ file.
inline std::string obj_of(const Soup& soup) {
  std::ostringstream text;
  text.precision(9);
  for (const glm::vec3& p : soup.positions)
    text << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (std::size_t i = 0; i + 2 < soup.corners.size(); i += 3) {
    text << "f " << soup.corners[i] + 1 << ' ' << soup.corners[i + 1] + 1 << ' '
         << soup.corners[i + 2] + 1 << '\n';
  }
  return text.str();
}

}  // namespace mesher::test
