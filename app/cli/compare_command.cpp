#include "app/cli/compare_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>

#include "app/cli/batch.h"
#include "app/cli/compare_look.h"
#include "app/cli/progress_line.h"
#include "app/cli/scene_compare.h"
#include "engine/analysis/self_intersections.h"
#include "engine/core/error.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

/// Times of bounding the distance, of measuring it, and of looking for intersections in each model:
/// 1.4 million faces compared with 0.1 million. Then of comparing the look.
constexpr double kCompareWeights[] = {0.5, 0.35, 0.08, 0.07, 0.5};

/// Expresses the positions of a model about another origin.
void move_origin(Model& model, const glm::dvec3& origin) {
  const glm::dvec3 offset = model.origin - origin;
  if (offset == glm::dvec3(0.0)) return;
  for (std::uint32_t v = 0; v < model.mesh.vertex_count(); ++v) {
    model.mesh.set_position(Vertex(v),
                            glm::vec3(glm::dvec3(model.mesh.position(Vertex(v))) + offset));
  }
  model.origin = origin;
}

/// Adds the distance of each mesh of two scenes.
void add_meshes(Json& json, const SceneDistance& scenes) {
  for (const MeshDistance& mesh : scenes.meshes) {
    Json one = to_json(mesh.distance);
    one["name"] = mesh.name;
    one["first_faces"] = mesh.first_faces;
    one["second_faces"] = mesh.second_faces;
    json["meshes"].push_back(std::move(one));
  }
  json["meshes_of_one_file"] = scenes.alone;
}

void print_row(const std::string& label, const std::string& value) {
  std::cout << fmt::format("{:<22}{}\n", printable(label), printable(value));
}

/// All that is measured.
struct Comparison {
  analysis::DistanceInterval certified;
  analysis::SurfaceDistance distance;
  std::uint64_t first_pairs = 0;
  std::uint64_t second_pairs = 0;
  SceneDistance scenes;
  analysis::LookDeviation look;
  std::optional<PictureDifferences> pictures;
};

Comparison compare(const LoadedModel& a, const LoadedModel& b, const CompareArguments& arguments,
                   Progress* progress) {
  const Mesh& first = a.model.mesh;
  const Mesh& second = b.model.mesh;
  Comparison result;
  Stages stages(progress, kCompareWeights);
  stages.next();
  result.certified = analysis::hausdorff_bounds(first, second, {.progress = progress}).two_sided();
  stages.next();
  result.distance = analysis::surface_distance(
      first, second, {.samples = arguments.samples, .progress = progress});
  stages.next("looking for intersections");
  result.first_pairs = analysis::count_self_intersections(first, progress);
  stages.next();
  result.second_pairs = analysis::count_self_intersections(second, progress);
  stages.next();
  result.look = look_deviation(a.model, b.model, arguments.samples, progress);
  return result;
}

Json comparison_json(const LoadedModel& a, const LoadedModel& b, const CompareArguments& arguments,
                     const Comparison& found) {
  Json json = to_json(found.distance, found.certified);
  json["first"] = a.file.string();
  json["second"] = b.file.string();
  json["first_faces"] = a.statistics.faces;
  json["second_faces"] = b.statistics.faces;
  json["samples"] = arguments.samples;
  json["first_self_intersections"] = found.first_pairs;
  json["second_self_intersections"] = found.second_pairs;
  if (!found.scenes.meshes.empty()) add_meshes(json, found.scenes);
  add_look(json, found.look, found.distance.diagonal);
  if (found.pictures) json["pictures"] = to_json(*found.pictures);
  add_pm(json, a.pm, "first_pm");
  add_pm(json, b.pm, "second_pm");
  return json;
}

void print_text(const Comparison& found) {
  const analysis::SurfaceDistance& distance = found.distance;
  const auto side = [&](const char* label, const analysis::OneSidedDistance& one) {
    print_row(label, fmt::format("rms {} ({}), mean {}, max {} ({})", number_text(one.rms),
                                 percent_text(distance.percent(one.rms)), number_text(one.mean),
                                 number_text(one.max), percent_text(distance.percent(one.max))));
  };
  side("first to second", distance.forward);
  side("second to first", distance.backward);
  side("two-sided", distance.two_sided());
  print_row("self-intersections",
            fmt::format("{} pairs of faces in the first, {} in the second",
                        count_text(static_cast<std::int64_t>(found.first_pairs)),
                        count_text(static_cast<std::int64_t>(found.second_pairs))));
  const analysis::DistanceInterval& certified = found.certified;
  print_row("certified max", fmt::format("{} to {} ({} to {})", number_text(certified.lower),
                                         number_text(certified.upper),
                                         percent_text(distance.percent(certified.lower)),
                                         percent_text(distance.percent(certified.upper))));
  for (const auto& [label, text] : rows_of(found.scenes))
    print_row(label, text);
  for (const auto& [label, text] : rows_of(found.look, distance.diagonal))
    print_row(label, text);
  if (!found.pictures) return;
  for (const auto& [label, text] : rows_of(*found.pictures))
    print_row(label, text);
}

}  // namespace

void add_compare_options(CLI::App& command, CompareArguments& arguments) {
  command
      .add_option("--samples", arguments.samples,
                  "sample points per surface, distributed uniformly by area (default: 300000)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  PictureComparison& pictures = arguments.pictures;
  CLI::Option* folder = command.add_option(
      "--pictures", pictures.folder,
      "draw both models from all sides, measure how much the pictures differ, and write them to "
      "this folder: first, second and difference beside each other");
  command
      .add_option("--views", pictures.views,
                  "number of directions, distributed uniformly (default: 24)")
      ->check(CLI::Range(1U, 256U))
      ->needs(folder);
  command
      .add_option("--picture-size", pictures.size,
                  "size of these pictures: N or WxH [pixels] (default: 800x600)")
      ->needs(folder);
  command.add_option("--device", pictures.device, "GPU: its number or part of its name")
      ->needs(folder);
}

void run_compare(const InputOptions& first, const InputOptions& second,
                 const CompareArguments& arguments, const CommonOptions& common) {
  if (!arguments.pictures.folder.empty()) check_pictures(arguments.pictures);
  for (const InputOptions* const input : {&first, &second})
    check_pose(*input);
  const LoadedModel a = load(first, common);
  LoadedModel b = load(second, common);
  move_origin(b.model, a.model.origin);
  for (const LoadedModel* const model : std::initializer_list<const LoadedModel*>{&a, &b}) {
    if (model->statistics.faces == 0) {
      throw InputError(model->file.string(), 0, "has no faces to compare");
    }
  }
  Comparison found;
  std::optional<PictureDifferences> pictures;
  {
    ProgressLine line(!common.quiet);
    const bool draws = !arguments.pictures.folder.empty();
    Stages stages(line.progress(), {draws ? 1.0 : 0.0, 1.0, 0.0});
    // First, because a machine may have no device to draw with.
    stages.next();
    if (draws) pictures = compare_pictures(a, b, arguments.pictures, line.progress());
    stages.next();
    found = compare(a, b, arguments, line.progress());
    stages.next();
    found.scenes = compare_scenes(first, second, arguments.samples, line.progress());
    found.pictures = std::move(pictures);
  }
  if (common.json) {
    Json json = comparison_json(a, b, arguments, found);
    if (first.animation) json["pose"] = {{"animation", *first.animation}, {"time_s", first.time_s}};
    return print_json(json);
  }
  print_text(found);
}

}  // namespace mesher::app
