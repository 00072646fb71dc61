#include "app/cli/subdivide_command.h"

#include <fmt/format.h>

#include <chrono>

#include "app/cli/batch.h"
#include "app/cli/progress_line.h"
#include "app/document/json.h"
#include "app/edit/memory_budget.h"
#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/core/text.h"
#include "engine/subdivide/attributes.h"
#include "engine/subdivide/subdivide.h"

namespace mesher::app {
namespace {

/// Times of subdividing the mesh and its attributes.
constexpr double kBothWeights[] = {0.75, 0.25};
constexpr double kMeshWeights[] = {1.0, 0.0};

void check_memory(const Model& model, const subdivide::SubdivideOptions& options) {
  const std::string refusal =
      subdivision_refusal(subdivide::subdivision_size(model.mesh, options), options.levels,
                          {.available = available_memory_bytes(),
                           .beside = subdivide::subdivided_attribute_bytes(
                               model.mesh, model.attributes, options.levels)});
  if (!refusal.empty()) throw DeviceError(refusal);
}

/// Subdivides in place; returns the time in seconds.
double subdivide_model(Model& model, subdivide::SubdivideOptions options,
                       const CommonOptions& common) {
  ProgressLine line(!common.quiet);
  options.progress = line.progress();
  Stages stages(line.progress(), model.attributes.is_empty() ? kMeshWeights : kBothWeights);
  stages.next();
  const auto start = std::chrono::steady_clock::now();
  subdivide::Subdivided result = subdivide::subdivide(model.mesh, options);
  stages.next();
  model.attributes = subdivide::subdivide_attributes(model.mesh, model.attributes, result.mesh,
                                                     options.levels, options.progress);
  model.mesh = std::move(result.mesh);
  set_normals(model.mesh, model.attributes, result.limit_normal);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Json counts(const Mesh& mesh) {
  return {{"vertices", mesh.vertex_count()}, {"faces", mesh.face_count()}};
}

}  // namespace

void run_subdivide(const InputOptions& input, const std::string& output,
                   const subdivide::SubdivideOptions& options, const CommonOptions& common) {
  check_output(output);
  LoadedModel loaded = load(input, common);
  Model& model = loaded.model;
  if (model.mesh.face_count() == 0) {
    throw InputError(loaded.file.string(), 0, "has no faces to subdivide");
  }
  check_memory(model, options);
  const Json before = counts(model.mesh);
  const bool has_normals = model.attributes.find(AttributeKind::normal) != nullptr;
  const double seconds = subdivide_model(model, options, common);
  const bool drops_normals = has_normals && model.attributes.find(AttributeKind::normal) == nullptr;
  if (!common.quiet) {
    say(fmt::format("subdivided {}x ({}) in {}", options.levels, key(options.scheme),
                    seconds_text(seconds)));
    if (drops_normals) say("dropped normals (they belong to the coarse surface)");
    if (options.limit && !subdivide::traits(options.scheme).has_limit) {
      say("--limit has no effect: the vertices of this scheme are on their limit surface");
    }
  }
  const std::vector<std::string> losses = write_result(output, model, common);
  if (!common.json) return;
  Json json{{"input", loaded.file.string()}, {"output", output}, {"levels", options.levels}};
  json.update(options_json(subdivide::kSubdivideRules, options));
  json.update({{"before", before},
               {"after", counts(model.mesh)},
               {"seconds", seconds},
               {"dropped", drops_normals ? Json{"normals"} : Json::array()},
               {"lost", losses},
               {"repairs", to_json(loaded.model.report)}});
  add_pm(json, loaded.pm);
  print_json(json);
}

}  // namespace mesher::app
