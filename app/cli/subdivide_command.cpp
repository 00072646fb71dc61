#include "app/cli/subdivide_command.h"

#include <chrono>

#include "app/cli/batch.h"
#include "app/cli/enum_words.h"
#include "app/cli/progress_line.h"
#include "app/json.h"
#include "app/memory_budget.h"
#include "app/words.h"
#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/subdivide/attributes.h"
#include "engine/subdivide/subdivide.h"

namespace mesher::app {
namespace {

void check_memory(const Model& model, const SubdivideOptions& options) {
  const std::string refusal =
      subdivision_refusal(subdivision_size(model.mesh, options), options.levels,
                          {.available = available_memory_bytes(),
                           .beside = subdivided_attribute_bytes(model.attributes, options.levels)});
  if (!refusal.empty()) throw DeviceError(refusal);
}

/// In place; returns the seconds it took.
double subdivide_model(Model& model, SubdivideOptions options, const CommonOptions& common) {
  ProgressLine line(!common.quiet);
  options.progress = line.progress();
  const auto start = std::chrono::steady_clock::now();
  Subdivided result = subdivide(model.mesh, options);
  model.mesh = std::move(result.mesh);
  model.attributes = subdivide_attributes(model.attributes, options.levels, options.progress);
  if (!result.limit_normal.empty()) model.attributes.normal = std::move(result.limit_normal);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Json counts(const Mesh& mesh) {
  return {{"vertices", mesh.vertex_count()}, {"faces", mesh.face_count()}};
}

}  // namespace

std::vector<std::string> scheme_words() {
  return enum_words<Scheme, kSchemeCount>();
}

std::vector<std::string> crease_rules_words() {
  return enum_words<CreaseRules, kCreaseRulesCount>();
}

std::vector<std::string> boundary_rounding_words() {
  return enum_words<BoundaryRounding, kBoundaryRoundingCount>();
}

std::vector<std::string> crease_decay_words() {
  return enum_words<CreaseDecay, kCreaseDecayCount>();
}

SubdivideOptions subdivide_options(const SubdivideWords& words) {
  return {.levels = words.levels,
          .scheme = enum_value<Scheme, kSchemeCount>(words.scheme),
          .creases = enum_value<CreaseRules, kCreaseRulesCount>(words.creases),
          .boundary = enum_value<BoundaryRounding, kBoundaryRoundingCount>(words.boundary),
          .decay = enum_value<CreaseDecay, kCreaseDecayCount>(words.decay),
          .limit = words.limit};
}

void run_subdivide(const InputOptions& input, const std::string& output,
                   const SubdivideWords& words, const CommonOptions& common) {
  check_output(output);
  const SubdivideOptions options = subdivide_options(words);
  LoadedModel loaded = load(input, common);
  Model& model = loaded.model;
  if (model.mesh.face_count() == 0) {
    throw InputError(loaded.file.string(), 0, "has no faces to subdivide");
  }
  check_memory(model, options);
  const Json before = counts(model.mesh);
  const bool has_normals = !model.attributes.normal.empty();
  const double seconds = subdivide_model(model, options, common);
  const bool drops_normals = has_normals && model.attributes.normal.empty();
  if (!common.quiet) {
    say("subdivided " + std::to_string(options.levels) + "x (" + words.scheme + ") in " +
        short_number(seconds) + " s");
    if (drops_normals) say("dropped normals (they were those of the coarse surface)");
    if (options.limit && options.scheme != Scheme::loop) {
      say("--limit: the vertices of this scheme are where they will stay; nothing moved");
    }
  }
  const std::vector<std::string> losses = write_result(output, model, common);
  if (!common.json) return;
  Json json{{"input", loaded.file.string()},
            {"output", output},
            {"levels", options.levels},
            {"scheme", words.scheme},
            {"creases", words.creases},
            {"boundary", words.boundary},
            {"crease_decay", words.decay},
            {"limit", options.limit},
            {"before", before},
            {"after", counts(model.mesh)},
            {"seconds", seconds},
            {"dropped", drops_normals ? Json{"normals"} : Json::array()},
            {"lost", losses},
            {"repairs", to_json(loaded.model.report)}};
  add_pm(json, loaded.pm);
  print_json(json);
}

}  // namespace mesher::app
