#include <chrono>

#include "app/cli/batch.h"
#include "app/cli/progress_line.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"
#include "app/cli/subdivide_command.h"

namespace mesher::app {
namespace {

void check_memory_of_all(const LoadedScene& scene, const subdivide::SubdivideOptions& options) {
  std::uint64_t held = 0;
  for (const io::GltfSceneMesh& mesh : scene.meshes)
    held += check_memory(mesh.model, options, held);
}

/// Subdivides all meshes. Returns whether any of them lost tangents.
bool subdivide_all(LoadedScene& scene, subdivide::SubdivideOptions options, bool shows_progress) {
  ProgressLine line(shows_progress);
  options.progress = line.progress();
  std::vector<double> sizes;
  for (const io::GltfSceneMesh& mesh : scene.meshes)
    sizes.push_back(mesh.model.mesh.face_count());
  Stages stages(line.progress(), sizes);
  bool drops_tangents = false;
  for (io::GltfSceneMesh& mesh : scene.meshes) {
    stages.next("subdividing");
    drops_tangents |= subdivide_model(mesh.model, options);
  }
  return drops_tangents;
}

Json counts_of(const LoadedScene& scene) {
  return {{"vertices", scene.vertex_count()}, {"faces", scene.face_count()}};
}

}  // namespace

void subdivide_scene(const InputOptions& input, const std::string& output,
                     const subdivide::SubdivideOptions& options, const CommonOptions& common) {
  LoadedScene scene = load_scene_with_faces(input, common, "subdivide");
  check_memory_of_all(scene, options);
  const Json before = counts_of(scene);
  const auto start = std::chrono::steady_clock::now();
  const bool drops_tangents = subdivide_all(scene, options, !common.quiet);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!common.quiet) say_subdivided(options, seconds, drops_tangents);
  std::vector<io::GltfMeshEdit> edits;
  for (const io::GltfSceneMesh& mesh : scene.meshes)
    edits.push_back(edit_of(mesh));
  const std::vector<std::string> losses = write_scene(output, scene, edits, common);
  if (!common.quiet) say_scene(output, scene);
  if (!common.json) return;
  Json json{{"input", scene.file.string()}, {"output", output}, {"levels", options.levels}};
  json.update(options_json(subdivide::kSubdivideRules, options));
  json.update({{"before", before},
               {"after", counts_of(scene)},
               {"seconds", seconds},
               {"lost", losses},
               {"repairs", to_json(scene.report)}});
  print_json(json);
}

}  // namespace mesher::app
