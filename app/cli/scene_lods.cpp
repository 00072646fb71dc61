#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "app/cli/batch.h"
#include "app/cli/lod_level.h"
#include "app/cli/progress_line.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"
#include "app/document/words.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/shapes.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

/// A level of all meshes, in the order of the scene's.
using SceneLevel = std::vector<simplify::ReducedShape>;

/// The meshes as they are.
SceneLevel full_level(const LoadedScene& scene) {
  SceneLevel level;
  for (const io::GltfSceneMesh& mesh : scene.meshes) {
    level.emplace_back().shape = {mesh.model.mesh, mesh.model.attributes};
    level.back().report.certified_bound = 0.0;
  }
  return level;
}

/// Levels by ratio share what is known of the costs; an error needs a reducer of its own.
std::vector<SceneLevel> make_scene_levels(const LoadedScene& scene,
                                          const std::vector<LodTarget>& targets,
                                          const LodArguments& arguments, bool shows_progress) {
  const auto reducer_with = [&](const simplify::SimplifyOptions& rules) {
    return std::make_unique<simplify::ShapesReducer>(
        shapes_of(scene), simplify::ShapesOptions{.rules = rules,
                                                  .prunes = arguments.simplify.prune,
                                                  .keeps_cards = arguments.simplify.keeps_cards,
                                                  .per_shape = arguments.simplify.per_mesh});
  };
  ProgressLine line(shows_progress);
  Stages stages(line.progress(), std::vector<double>(targets.size(), 1.0));
  const auto by_ratio = reducer_with(lod_options(arguments, 1, 1, scene.diagonal));
  std::vector<SceneLevel> levels;
  for (const LodTarget& target : targets) {
    stages.next("simplifying");
    if (target.is_full()) {
      levels.push_back(full_level(scene));
    } else if (target.ratio) {
      levels.push_back(by_ratio->reduce(scene_faces_for(*target.ratio, scene), line.progress()));
    } else {
      const auto within = reducer_with(lod_options_within(arguments, target.max_error));
      levels.push_back(within->reduce(0, line.progress()));
    }
  }
  return levels;
}

LodLevel facts_of(const LoadedScene& scene, const SceneLevel& level, const LodTarget& target) {
  LodLevel facts{.ratio = target.ratio.value_or(1.0),
                 .asked_faces = target.ratio ? scene_faces_for(*target.ratio, scene) : 0};
  double area = 0.0;
  double squares = 0.0;
  bool is_bounded = true;
  for (std::size_t m = 0; m < level.size(); ++m) {
    const io::GltfSceneMesh& mesh = scene.meshes[m];
    const simplify::ReducedShape& shape = level[m];
    const std::uint64_t weight = scene.weight(mesh);
    facts.vertices += weight * shape.shape.mesh.vertex_count();
    facts.faces += weight * shape.shape.mesh.face_count();
    facts.cards.cards += shape.cards.cards;
    facts.cards.removed += shape.cards.removed;
    facts.cards.enlarged = std::max(facts.cards.enlarged, shape.cards.enlarged);
    const double counts =
        double(weight) * mesh.scale * mesh.scale * statistics(mesh.model.mesh).area;
    const double error = mesh.scale * shape.report.estimated_error;
    area += counts;
    squares += counts * error * error;
    is_bounded &= shape.report.certified_bound >= 0.0;
    facts.bound = std::max(facts.bound, mesh.scale * shape.report.certified_bound);
  }
  if (!is_bounded) facts.bound = -1.0;
  facts.rms = area > 0.0 ? std::sqrt(squares / area) : 0.0;
  return facts;
}

/// Why a level has more faces than were asked for.
std::string why_of(const SceneLevel& level) {
  const bool is_far = std::ranges::any_of(level, [](const simplify::ReducedShape& shape) {
    return shape.report.reason == simplify::StopReason::far_from_input;
  });
  return stop_text(is_far ? simplify::StopReason::far_from_input
                          : simplify::StopReason::no_legal_collapse);
}

/// Returns whether a level has another mesh than the scene.
bool is_edited(const io::GltfSceneMesh& mesh, const simplify::ReducedShape& shape) {
  return shape.shape.mesh.face_count() < mesh.model.mesh.face_count();
}

/// The first level replaces its mesh only if it has fewer faces.
std::vector<io::GltfMeshEdit> edits_of(const LoadedScene& scene,
                                       const std::vector<SceneLevel>& levels,
                                       const LodReport& report) {
  std::vector<io::GltfMeshEdit> edits;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    io::GltfMeshEdit edit{.mesh = scene.meshes[m].index};
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const Shape& shape = levels[i][m].shape;
      edit.levels.push_back({&shape.mesh, &shape.attributes, report.levels[i].coverage});
    }
    edit.replaces = is_edited(scene.meshes[m], levels.front()[m]);
    edits.push_back(std::move(edit));
  }
  return edits;
}

/// Writes a scene per level and the manifest; either all files or none.
std::vector<std::string> write_separate(const std::string& output,
                                        const std::vector<fs::path>& files, LoadedScene& scene,
                                        const std::vector<SceneLevel>& levels,
                                        const LodReport& report, const CommonOptions& common) {
  std::vector<std::unique_ptr<io::AtomicFile>> open;
  std::vector<std::string> losses;
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::vector<io::GltfMeshEdit> edits;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
      const Shape& shape = levels[i][m].shape;
      if (is_edited(scene.meshes[m], levels[i][m]))
        edits.push_back(
            {.mesh = scene.meshes[m].index, .levels = {{&shape.mesh, &shape.attributes}}});
    }
    open.push_back(std::make_unique<io::AtomicFile>(files[i]));
    for (std::string& loss : write_scene(*open.back(), scene, std::move(edits), common)) {
      if (std::ranges::find(losses, loss) == losses.end()) losses.push_back(std::move(loss));
    }
  }
  open.push_back(std::make_unique<io::AtomicFile>(manifest_file(output)));
  write_manifest(*open.back(), report, files, scene.file);
  io::AtomicFile::commit_all(open, common.flush());
  if (!common.quiet) say_losses(output, losses);
  return losses;
}

}  // namespace

void write_scene_lods(const InputOptions& input, const std::string& output,
                      const std::vector<fs::path>& files, const LodArguments& arguments,
                      const CommonOptions& common) {
  LoadedScene scene = load_scene_with_faces(input, common, "simplify");
  const std::vector<LodTarget> targets = lod_targets(arguments, scene.diagonal);
  const std::vector<SceneLevel> levels =
      make_scene_levels(scene, targets, arguments, !common.quiet);
  LodReport report{.screen = arguments.screen, .diagonal = scene.diagonal};
  for (std::size_t i = 0; i < levels.size(); ++i)
    report.levels.push_back(facts_of(scene, levels[i], targets[i]));
  set_coverage(report.levels, arguments, std::max<std::uint64_t>(scene.face_count(), 1));
  const bool is_one = files.front() == output;
  const std::vector<std::string> losses =
      is_one ? write_scene(output, scene, edits_of(scene, levels, report), common)
             : write_separate(output, files, scene, levels, report, common);
  if (!common.quiet) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
      say(level_text(report, i, why_of(levels[i])));
      say_rest_of_level(report, i);
    }
    for (const fs::path& file : files)
      say("wrote " + file.string());
    if (!is_one) say("wrote " + manifest_file(output).string());
  }
  if (!common.json) return;
  Json json{{"input", scene.file.string()},
            {"output", output},
            {"files", Json::array()},
            {"manifest", is_one ? Json() : Json(manifest_file(output).string())},
            {"meshes", scene.meshes.size()},
            {"faces_before", scene.face_count()},
            {"screen", screen_json(report.screen, report.diagonal)},
            {"levels", Json::array()}};
  for (const fs::path& file : files)
    json["files"].push_back(file.string());
  for (std::size_t i = 0; i < levels.size(); ++i)
    json["levels"].push_back(level_json(report, i));
  json["lost"] = losses;
  json["repairs"] = to_json(scene.report);
  print_json(json);
}

}  // namespace mesher::app
