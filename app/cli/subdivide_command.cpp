#include "app/cli/subdivide_command.h"

#include <fmt/format.h>

#include <chrono>

#include "app/cli/batch.h"
#include "app/cli/progress_line.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"
#include "app/document/json.h"
#include "app/edit/memory_budget.h"
#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/memory.h"
#include "engine/core/text.h"
#include "engine/subdivide/attributes.h"
#include "engine/subdivide/subdivide.h"

namespace mesher::app {
namespace {

/// Times of subdividing the mesh and its attributes.
constexpr double kBothWeights[] = {0.75, 0.25};
constexpr double kMeshWeights[] = {1.0, 0.0};

Json counts(const Mesh& mesh) {
  return {{"vertices", mesh.vertex_count()}, {"faces", mesh.face_count()}};
}

}  // namespace

std::uint64_t check_memory(const Model& model, const subdivide::SubdivideOptions& options,
                           std::uint64_t held) {
  const subdivide::SubdivisionSize size = subdivide::subdivision_size(model.mesh, options);
  const std::uint64_t beside =
      subdivide::subdivided_attribute_bytes(model.mesh, model.attributes, options);
  FaceLimit::check(size.faces, "the subdivided mesh ");
  const std::uint64_t available = available_memory_bytes();
  // Asking for it takes some memory itself.
  constexpr std::uint64_t kAsking = std::uint64_t{1} << 20U;
  const bool is_limited =
      MemoryLimit::counts_everything() && MemoryLimit::left() <= available + kAsking;
  const std::string refusal = subdivision_refusal(
      size, options.levels,
      {.available = available, .beside = beside, .held = held, .is_limited = is_limited});
  if (!refusal.empty() && is_limited) throw LimitError(refusal);
  if (!refusal.empty()) throw DeviceError(refusal);
  return size.result_bytes + beside;
}

bool subdivide_model(Model& model, const subdivide::SubdivideOptions& options) {
  const bool had_tangents = model.attributes.find(AttributeKind::tangent) != nullptr;
  Stages stages(options.progress, model.attributes.is_empty() ? kMeshWeights : kBothWeights);
  stages.next();
  subdivide::Subdivided result = subdivide::subdivide(model.mesh, options);
  stages.next();
  model.attributes =
      subdivide::subdivide_attributes(model.mesh, model.attributes, result.mesh, options);
  model.mesh = std::move(result.mesh);
  set_normals(model.mesh, model.attributes, result.limit_normal);
  return had_tangents && model.attributes.find(AttributeKind::tangent) == nullptr;
}

void say_subdivided(const subdivide::SubdivideOptions& options, double seconds,
                    bool drops_tangents) {
  say(fmt::format("subdivided {}x ({}) in {}", options.levels, key(options.scheme),
                  seconds_text(seconds)));
  if (drops_tangents) say("dropped tangents (they belong to the coarse surface)");
  if (options.limit && !subdivide::traits(options.scheme).has_limit) {
    say("--limit has no effect: the vertices of this scheme are on their limit surface");
  }
}

void run_subdivide(const InputOptions& input, const std::string& output,
                   const subdivide::SubdivideOptions& options, const CommonOptions& common) {
  check_output(output);
  if (keeps_scene(input, output, common)) return subdivide_scene(input, output, options, common);
  LoadedModel loaded = load(input, common);
  Model& model = loaded.model;
  if (model.mesh.face_count() == 0) {
    throw InputError(loaded.file.string(), 0, "has no faces to subdivide");
  }
  check_memory(model, options);
  const Json before = counts(model.mesh);
  bool drops_tangents = false;
  const auto start = std::chrono::steady_clock::now();
  {
    ProgressLine line(!common.quiet);
    subdivide::SubdivideOptions watched = options;
    watched.progress = line.progress();
    drops_tangents = subdivide_model(model, watched);
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!common.quiet) say_subdivided(options, seconds, drops_tangents);
  const std::vector<std::string> losses = write_result(output, model, common);
  if (!common.json) return;
  Json json{{"input", loaded.file.string()}, {"output", output}, {"levels", options.levels}};
  json.update(options_json(subdivide::kSubdivideRules, options));
  json.update({{"before", before},
               {"after", counts(model.mesh)},
               {"seconds", seconds},
               {"lost", losses},
               {"repairs", to_json(loaded.model.report)}});
  add_pm(json, loaded.pm);
  print_json(json);
}

}  // namespace mesher::app
