#include "app/cli/scene_compare.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/cli/batch.h"
#include "app/cli/scene.h"
#include "app/files/paths.h"
#include "engine/core/text.h"
#include "engine/io/format.h"

namespace mesher::app {
namespace {

std::vector<io::GltfSceneMesh> meshes_of(const InputOptions& input, Progress* progress) {
  const std::filesystem::path file = find_model(input.model);
  const io::FormatInfo* const format = io::format_of(file);
  if (format == nullptr || format->read_scene == nullptr) return {};
  io::ReadOptions options = read_options(input);
  options.progress = progress;
  return io::GltfScene(file, options).read_meshes(options);
}

/// Returns the mesh to compare with mesh `i`, or null.
const io::GltfSceneMesh* match_of(std::size_t i, const std::vector<io::GltfSceneMesh>& meshes,
                                  const std::vector<io::GltfSceneMesh>& others) {
  if (meshes.size() == others.size()) return &others[i];
  const auto found = std::ranges::find_if(others, [&](const io::GltfSceneMesh& other) {
    return !other.model.name.empty() && other.model.name == meshes[i].model.name;
  });
  return found == others.end() ? nullptr : &*found;
}

}  // namespace

SceneDistance compare_scenes(const InputOptions& first, const InputOptions& second,
                             std::uint64_t samples, Progress* progress) {
  constexpr double kWeights[] = {0.1, 0.1, 0.8};
  Stages stages(progress, kWeights);
  stages.next();
  const std::vector<io::GltfSceneMesh> a = meshes_of(first, progress);
  stages.next();
  const std::vector<io::GltfSceneMesh> b = meshes_of(second, progress);
  stages.next("comparing meshes");
  SceneDistance scenes;
  if (a.empty() || b.empty() || (a.size() == 1 && b.size() == 1)) return scenes;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const io::GltfSceneMesh* const other = match_of(i, a, b);
    if (other == nullptr) {
      scenes.alone.push_back(name_of(a[i]));
      continue;
    }
    scenes.meshes.push_back(
        {name_of(a[i]), a[i].model.mesh.face_count(), other->model.mesh.face_count(),
         analysis::surface_distance(a[i].model.mesh, other->model.mesh, {.samples = samples})});
    check_cancelled(progress);
  }
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (match_of(i, b, a) == nullptr) scenes.alone.push_back(name_of(b[i]));
  }
  return scenes;
}

std::vector<std::pair<std::string, std::string>> rows_of(const SceneDistance& scenes) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const MeshDistance& mesh : scenes.meshes) {
    const analysis::OneSidedDistance both = mesh.distance.two_sided();
    rows.emplace_back(
        "mesh " + mesh.name,
        fmt::format("rms {} ({}), max {} ({}), {} and {}", number_text(both.rms),
                    percent_text(mesh.distance.percent(both.rms)), number_text(both.max),
                    percent_text(mesh.distance.percent(both.max)),
                    count_text(mesh.first_faces, "face"), count_text(mesh.second_faces)));
  }
  for (const std::string& name : scenes.alone)
    rows.emplace_back("mesh " + name, "only in one of the files");
  return rows;
}

}  // namespace mesher::app
