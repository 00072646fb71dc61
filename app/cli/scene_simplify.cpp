#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "app/cli/batch.h"
#include "app/cli/progress_line.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"
#include "app/cli/streams.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/shapes.h"

namespace mesher::app {
namespace {

/// A mesh of the scene and what became of it.
struct MeshOutcome {
  const io::GltfSceneMesh* mesh;
  std::uint64_t weight = 1;  ///< how often it counts
  double area = 0.0;         ///< in the scene
  SimplifyOutcome outcome;   ///< lengths are those of the scene
};

/// Returns what the arguments mean for a scene.
simplify::ShapesOptions options_for(const LoadedScene& scene, SimplifyArguments arguments) {
  simplify::ShapesOptions options;
  arguments.faces.reset();
  if (!arguments.ratio && arguments.max_error.empty()) arguments.ratio = 1.0;
  options.rules = simplify_options(arguments, 1, scene.diagonal);
  options.prunes = arguments.prune;
  options.keeps_cards = arguments.keeps_cards;
  options.per_shape = arguments.per_mesh;
  return options;
}

/// Returns the number of faces that the scene should show; 0: no target.
std::uint64_t target_for(const LoadedScene& scene, const SimplifyArguments& arguments) {
  if (arguments.faces) return *arguments.faces;
  return arguments.ratio ? scene_faces_for(*arguments.ratio, scene) : 0;
}

void scale_lengths(simplify::SimplifyReport& report, double scale) {
  for (double* length : {&report.estimated_error, &report.measured_error, &report.certified_bound,
                         &report.largest_pruned, &report.error_unpruned}) {
    if (*length > 0.0) *length *= scale;
  }
}

/// Makes the mesh what became of it.
MeshOutcome outcome_of(io::GltfSceneMesh& mesh, const LoadedScene& scene,
                       simplify::ReducedShape&& reduced) {
  const double area = statistics(mesh.model.mesh).area * mesh.scale * mesh.scale;
  mesh.model.mesh = std::move(reduced.shape.mesh);
  mesh.model.attributes = std::move(reduced.shape.attributes);
  MeshOutcome result{.mesh = &mesh, .weight = scene.weight(mesh), .area = area};
  result.outcome.report = reduced.report;
  result.outcome.crosses_seams = reduced.crosses_seams;
  result.outcome.cards = reduced.cards;
  scale_lengths(result.outcome.report, mesh.scale);
  return result;
}

void add(simplify::SimplifyReport& sum, const MeshOutcome& part) {
  const simplify::SimplifyReport& r = part.outcome.report;
  // Instances may show more faces than 32 bits count.
  const auto add_times = [&](std::uint32_t& total, std::uint32_t count) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    const bool is_too_many = count > 0 && part.weight > (kMost - total) / count;
    total = is_too_many ? std::uint32_t{kMost}
                        : static_cast<std::uint32_t>(total + part.weight * count);
  };
  add_times(sum.faces_before, r.faces_before);
  add_times(sum.faces_asked, r.faces_asked);
  add_times(sum.faces_reached, r.faces_reached);
  add_times(sum.vertices_before, r.vertices_before);
  add_times(sum.vertices_reached, r.vertices_reached);
  sum.collapses += r.collapses;
  for (std::size_t i = 0; i < sum.rejected.size(); ++i)
    sum.rejected[i] += r.rejected[i];
  sum.measured_error = std::max(sum.measured_error, r.measured_error);
  sum.certified_bound = std::max(sum.certified_bound, r.certified_bound);
  sum.pruned_parts += r.pruned_parts;
  sum.pruned_faces += r.pruned_faces;
  sum.largest_pruned = std::max(sum.largest_pruned, r.largest_pruned);
  sum.seconds += r.seconds;
}

void add(simplify::ThinnedCards& sum, const simplify::ThinnedCards& part) {
  sum.cards += part.cards;
  sum.removed += part.removed;
  sum.enlarged = std::max(sum.enlarged, part.enlarged);
}

/// Returns the report of the whole scene. Its reason is that of the mesh that missed its target by
/// most; errors are the root mean square over the area of the scene, bounds the largest. `target`:
/// number of faces; 0: none.
SimplifyOutcome total_of(const std::vector<MeshOutcome>& parts, std::uint64_t target,
                         double diagonal) {
  SimplifyOutcome total;
  total.diagonal = diagonal;
  simplify::SimplifyReport& sum = total.report;
  sum.reason = simplify::StopReason::already_there;
  double area = 0.0;
  double squares = 0.0;
  double squares_unpruned = 0.0;
  std::uint32_t missed = 0;
  for (const MeshOutcome& part : parts) {
    const simplify::SimplifyReport& r = part.outcome.report;
    add(sum, part);
    total.crosses_seams |= part.outcome.crosses_seams;
    add(total.cards, part.outcome.cards);
    const double weight = part.area * double(part.weight);
    area += weight;
    squares += weight * r.estimated_error * r.estimated_error;
    squares_unpruned += weight * r.error_unpruned * r.error_unpruned;
    const std::uint32_t by = r.faces_reached - std::min(r.faces_asked, r.faces_reached);
    const bool is_worse = by > missed;
    const bool is_first = missed == 0 && sum.reason == simplify::StopReason::already_there;
    if (is_worse || is_first) sum.reason = r.reason;
    missed = std::max(missed, by);
  }
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  sum.faces_asked = static_cast<std::uint32_t>(std::min(target, kMost));
  const bool has_reason = missed > 0 || target == 0;
  if (!has_reason && sum.faces_reached > sum.faces_asked)
    sum.reason = simplify::StopReason::no_legal_collapse;  // each mesh has as few as it can
  else if (!has_reason && sum.faces_reached < sum.faces_before)
    sum.reason = simplify::StopReason::target_reached;
  if (area > 0.0) {
    sum.estimated_error = std::sqrt(squares / area);
    sum.error_unpruned = std::sqrt(squares_unpruned / area);
  }
  return total;
}

/// Says why a scene has fewer faces than were asked for, if a mesh with many instances is the
/// reason.
void say_steps(const std::vector<MeshOutcome>& parts, const SimplifyOutcome& total) {
  std::uint64_t most = 1;
  for (const MeshOutcome& part : parts)
    most = std::max(most, part.outcome.report.collapses > 0 ? part.weight : 1);
  const simplify::SimplifyReport& r = total.report;
  if (most == 1 || r.faces_reached + 2 >= r.faces_asked) return;
  say(fmt::format("a collapse in a mesh that is shown {} times removes up to {}",
                  count_text(static_cast<std::int64_t>(most)),
                  count_text(static_cast<std::int64_t>(2 * most), "face")));
}

Json meshes_json(const std::vector<MeshOutcome>& parts) {
  Json json = Json::array();
  for (const MeshOutcome& part : parts) {
    const simplify::SimplifyReport& r = part.outcome.report;
    json.push_back({{"name", name_of(*part.mesh)},
                    {"index", part.mesh->index},
                    {"placements", part.mesh->placements},
                    {"asked_faces", r.faces_asked > 0 ? Json(r.faces_asked) : Json()},
                    {"faces_before", r.faces_before},
                    {"faces_reached", r.faces_reached},
                    {"stop_reason", key(r.reason)},
                    {"estimated_error", r.estimated_error},
                    {"crosses_seams", part.outcome.crosses_seams},
                    {"loose_cards", to_json(part.outcome.cards)}});
  }
  return json;
}

}  // namespace

void simplify_scene(const InputOptions& input, const std::string& output,
                    const SimplifyArguments& arguments, const CommonOptions& common) {
  if (arguments.measure) refuse_stream(output, "--measure");
  LoadedScene scene = load_scene_with_faces(input, common, "simplify");
  const std::uint64_t target = target_for(scene, arguments);
  std::vector<MeshOutcome> parts;
  std::vector<io::GltfMeshEdit> edits;
  {
    ProgressLine line(!common.quiet);
    simplify::ShapesReducer reducer(shapes_of(scene), options_for(scene, arguments));
    std::vector<simplify::ReducedShape> reduced = reducer.reduce(target, line.progress());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
      parts.push_back(outcome_of(scene.meshes[i], scene, std::move(reduced[i])));
      const SimplifyOutcome& outcome = parts.back().outcome;
      const bool is_edited = outcome.report.collapses > 0 || outcome.report.pruned_parts > 0 ||
                             outcome.cards.removed > 0;
      if (is_edited) edits.push_back(edit_of(scene.meshes[i]));
    }
  }
  const SimplifyOutcome total = total_of(parts, target, scene.diagonal);
  if (!common.quiet) {
    say_outcome(total, arguments.prune);
    say_steps(parts, total);
  }
  CommonOptions quiet = common;
  quiet.quiet = true;
  // The output may replace the input.
  const Mesh before = arguments.measure ? load(input, quiet).model.mesh : Mesh();
  const std::vector<std::string> losses = write_scene(output, scene, edits, common);
  if (!common.quiet) say_scene(output, scene);
  Json measures = measures_json({}, {}, {}, common);
  if (arguments.measure) {
    const Mesh after = load({.model = output}, quiet).model.mesh;
    measures = measures_json(before, after, arguments, common);
  }
  if (!common.json) return;
  Json json{{"input", scene.file.string()}, {"output", output}};
  json.update(to_json(total));
  json.update(measures);
  json["loose_cards"] = to_json(total.cards);
  json["meshes"] = meshes_json(parts);
  json["lost"] = losses;
  json["repairs"] = to_json(scene.report);
  print_json(json);
}

}  // namespace mesher::app
