#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/cli/batch.h"
#include "app/cli/progress_line.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"
#include "app/document/shown.h"
#include "app/document/words.h"
#include "app/edit/distance_from_input.h"
#include "engine/core/text.h"
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

std::uint32_t target_faces(double ratio, std::uint32_t faces) {
  return std::max(1U, static_cast<std::uint32_t>(std::llround(ratio * faces)));
}

simplify::SimplifyOptions options_for(const io::GltfSceneMesh& mesh, std::uint32_t faces,
                                      const LodArguments& arguments, double diagonal,
                                      Progress* progress) {
  SimplifyArguments simplify = arguments.simplify;
  simplify.faces = faces;
  simplify::SimplifyOptions options = simplify_options(simplify, mesh.model.mesh.face_count(), 1.0);
  // Levels that nobody asked for by number end where they would be far from the scene.
  if (!arguments.ratios)
    options.stop_before_error = simplify::kFarFromInput * diagonal / mesh.scale;
  options.progress = progress;
  return options;
}

/// Simplifies once for all levels, or once for each if parts are pruned.
MeshLevels make_levels(const io::GltfSceneMesh& mesh, const std::vector<double>& ratios,
                       const LodArguments& arguments, double diagonal, Progress* progress) {
  const Model& full = mesh.model;
  const std::uint32_t faces = full.mesh.face_count();
  MeshLevels levels;
  for (const double ratio : ratios)
    levels.asked_faces.push_back(target_faces(ratio, faces));
  const auto options = [&](std::uint32_t target) {
    return options_for(mesh, target, arguments, diagonal, progress);
  };
  if (arguments.simplify.prune) {
    for (const std::uint32_t target : levels.asked_faces) {
      auto model =
          simplify::simplify_model(Mesh(full.mesh), full.attributes, options(target), true);
      levels.shapes.push_back({std::move(model.simplified.mesh), std::move(model.attributes)});
    }
    return levels;
  }
  Mesh marked = full.mesh;
  simplify::mark_seams(marked, full.attributes);
  progressive::Progressive made =
      progressive::make_progressive(marked, options(levels.asked_faces.back()));
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

/// A level of the whole scene, where a mesh counts as often as it is shown.
struct SceneLevel {
  double ratio = 1.0;
  double coverage = 0.0;
  std::uint64_t asked_faces = 0;
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  /// Root mean square distance from the input, in units of the scene; negative if this or a coarser
  /// level is near.
  double error = -1.0;
};

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

std::vector<SceneLevel> summary_of(const LoadedScene& scene, const std::vector<MeshLevels>& levels,
                                   const std::vector<double>& ratios,
                                   const std::vector<double>& coverage) {
  std::vector<SceneLevel> summary;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    SceneLevel level{.ratio = ratios[i], .coverage = coverage[i]};
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

void say_scene_levels(const std::vector<SceneLevel>& levels, double diagonal) {
  const auto number = [](std::uint64_t count) { return static_cast<std::int64_t>(count); };
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const SceneLevel& level = levels[i];
    say(fmt::format(
        "level {}: {} vertices, {}, for a coverage of at least {}{}", i,
        count_text(number(level.vertices)), count_text(number(level.faces), "face"),
        number_text(level.coverage),
        level.faces > level.asked_faces
            ? fmt::format("; asked for {}", count_text(number(level.asked_faces), "face"))
            : ""));
    if (level.error >= 0.0) {
      say(fmt::format("warning: level {} is {}", i,
                      far_from("the input", 100.0 * level.error / diagonal)));
    }
  }
}

Json level_json(const SceneLevel& level) {
  return {{"ratio", level.ratio},       {"asked_faces", level.asked_faces},
          {"vertices", level.vertices}, {"faces", level.faces},
          {"coverage", level.coverage}, {"far_from_input", level.error >= 0.0}};
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
  const std::vector<SceneLevel> summary = summary_of(scene, levels, ratios, coverage);
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
  for (const SceneLevel& level : summary)
    json["levels"].push_back(level_json(level));
  json["lost"] = losses;
  json["repairs"] = to_json(scene.report);
  print_json(json);
}

}  // namespace mesher::app
