#include <cmath>
#include <utility>

#include "app/cli/batch.h"
#include "app/cli/lod_level.h"
#include "app/cli/progress_line.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"
#include "app/document/shown.h"
#include "app/edit/distance_from_input.h"
#include "engine/mesh/statistics.h"
#include "engine/progressive/build.h"
#include "engine/simplify/attributes.h"
#include "engine/simplify/prune.h"

namespace mesher::app {
namespace {

/// The levels of one mesh; at 0 the mesh as it is.
struct MeshLevels {
  std::vector<Shape> shapes;
  std::vector<std::uint32_t> asked_faces;
};

/// Simplifies once for all levels, or once for each if parts are pruned.
MeshLevels make_levels(const io::GltfSceneMesh& mesh, const std::vector<double>& ratios,
                       const LodArguments& arguments, double diagonal, Progress* progress) {
  const Model& full = mesh.model;
  const std::uint32_t faces = full.mesh.face_count();
  MeshLevels levels;
  for (const double ratio : ratios)
    levels.asked_faces.push_back(faces_for(ratio, faces));
  const auto options_for = [&](std::uint32_t target) {
    simplify::SimplifyOptions options =
        lod_options(arguments, target, faces, diagonal / mesh.scale);
    options.progress = progress;
    return options;
  };
  if (arguments.simplify.prune) {
    for (const std::uint32_t target : levels.asked_faces) {
      auto model =
          simplify::simplify_model(Mesh(full.mesh), full.attributes, options_for(target), true);
      levels.shapes.push_back({std::move(model.simplified.mesh), std::move(model.attributes)});
    }
    return levels;
  }
  Mesh marked = full.mesh;
  simplify::mark_seams(marked, full.attributes);
  progressive::Progressive made =
      progressive::make_progressive(marked, options_for(levels.asked_faces.back()));
  for (const std::uint32_t target : levels.asked_faces) {
    made.mesh.go_to(made.mesh.level_for_faces(target));
    if (made.mesh.level() == made.mesh.split_count()) {
      levels.shapes.push_back({full.mesh, full.attributes});
      continue;
    }
    Mesh level = made.mesh.mesh();
    simplify::unmark_seams(level);
    levels.shapes.push_back(level_shape(level, made.face_source, full.mesh, full.attributes));
  }
  return levels;
}

std::vector<MeshLevels> make_all_levels(const LoadedScene& scene, const std::vector<double>& ratios,
                                        const LodArguments& arguments, bool shows_progress) {
  ProgressLine line(shows_progress);
  std::vector<double> sizes;
  for (const io::GltfSceneMesh& mesh : scene.meshes)
    sizes.push_back(mesh.model.mesh.face_count());
  Stages stages(line.progress(), sizes);
  std::vector<MeshLevels> levels;
  for (const io::GltfSceneMesh& mesh : scene.meshes) {
    stages.next("simplifying");
    levels.push_back(make_levels(mesh, ratios, arguments, scene.diagonal, line.progress()));
  }
  return levels;
}

/// Returns the distance of a level from the scene: the root mean square over its area.
double error_of(const LoadedScene& scene, const std::vector<MeshLevels>& levels, std::size_t i) {
  double area = 0.0;
  double squares = 0.0;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const io::GltfSceneMesh& mesh = scene.meshes[m];
    const double weight =
        double(scene.weight(mesh)) * mesh.scale * mesh.scale * statistics(mesh.model.mesh).area;
    const double error =
        mesh.scale * distance_from_input(mesh.model.mesh, levels[m].shapes[i].mesh);
    area += weight;
    squares += weight * error * error;
  }
  return area > 0.0 ? std::sqrt(squares / area) : 0.0;
}

std::vector<LodLevel> summary_of(const LoadedScene& scene, const std::vector<MeshLevels>& levels,
                                 const std::vector<double>& ratios,
                                 const std::vector<double>& coverage) {
  std::vector<LodLevel> summary;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    LodLevel level{.ratio = ratios[i], .coverage = coverage[i]};
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
      const std::uint64_t weight = scene.weight(scene.meshes[m]);
      level.asked_faces += weight * levels[m].asked_faces[i];
      level.vertices += weight * levels[m].shapes[i].mesh.vertex_count();
      level.faces += weight * levels[m].shapes[i].mesh.face_count();
    }
    summary.push_back(level);
  }
  // If a level is near the scene, the finer ones are near as well.
  for (std::size_t i = summary.size(); i-- > 0;) {
    const double error = error_of(scene, levels, i);
    if (error <= simplify::kFarFromInput * scene.diagonal) break;
    summary[i].error = error;
  }
  return summary;
}

void say_scene_levels(const std::vector<LodLevel>& levels, double diagonal) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    say(level_text(i, levels[i]));
    warn_if_far(i, levels[i], diagonal);
  }
}

/// The first level replaces its mesh only if it has fewer faces.
std::vector<io::GltfMeshEdit> edits_of(const LoadedScene& scene,
                                       const std::vector<MeshLevels>& levels,
                                       const std::vector<double>& coverage) {
  std::vector<io::GltfMeshEdit> edits;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    io::GltfMeshEdit edit{.mesh = scene.meshes[m].index};
    for (std::size_t i = 0; i < coverage.size(); ++i) {
      const Shape& shape = levels[m].shapes[i];
      edit.levels.push_back({&shape.mesh, &shape.attributes, coverage[i]});
    }
    edit.replaces =
        levels[m].shapes.front().mesh.face_count() < scene.meshes[m].model.mesh.face_count();
    edits.push_back(std::move(edit));
  }
  return edits;
}

}  // namespace

void write_scene_lods(const InputOptions& input, const std::string& output,
                      const std::vector<double>& ratios, const std::vector<double>& coverage,
                      const LodArguments& arguments, const CommonOptions& common) {
  LoadedScene scene = load_scene_with_faces(input, common, "simplify");
  const std::vector<MeshLevels> levels = make_all_levels(scene, ratios, arguments, !common.quiet);
  const std::vector<LodLevel> summary = summary_of(scene, levels, ratios, coverage);
  const std::vector<std::string> losses =
      write_scene(output, scene, edits_of(scene, levels, coverage), common);
  if (!common.quiet) {
    say_scene_levels(summary, scene.diagonal);
    say("wrote " + output);
  }
  if (!common.json) return;
  Json json{{"input", scene.file.string()},       {"output", output},
            {"files", Json::array({output})},     {"meshes", scene.meshes.size()},
            {"faces_before", scene.face_count()}, {"levels", Json::array()}};
  for (const LodLevel& level : summary)
    json["levels"].push_back(level_json(level));
  json["lost"] = losses;
  json["repairs"] = to_json(scene.report);
  print_json(json);
}

}  // namespace mesher::app
