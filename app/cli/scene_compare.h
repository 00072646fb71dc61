#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/options.h"
#include "engine/analysis/distance.h"

namespace mesher::app {

/// The distance between a mesh of one scene and that of the same name in another, in the mesh's own
/// coordinates. Percentages are of its own diagonal.
struct MeshDistance {
  std::string name;
  std::uint32_t first_faces = 0;
  std::uint32_t second_faces = 0;
  analysis::SurfaceDistance distance;
};

/// The meshes of two scenes, one by one.
struct SceneDistance {
  std::vector<MeshDistance> meshes;
  std::vector<std::string> alone;  ///< names of meshes that only one of the scenes has
};

/// Compares two glTF files mesh by mesh. Meshes are matched by number if both files have as many,
/// otherwise by name. Empty if a file is of another format, or both have one mesh. Throws
/// InputError; Cancelled.
SceneDistance compare_scenes(const InputOptions& first, const InputOptions& second,
                             std::uint64_t samples, Progress* progress);

/// A label and what is printed behind it, for each mesh.
std::vector<std::pair<std::string, std::string>> rows_of(const SceneDistance& scenes);

}  // namespace mesher::app
