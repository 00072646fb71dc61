#include "app/cli/lods_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/cli/batch.h"
#include "app/cli/lod_level.h"
#include "app/cli/progress_line.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"
#include "app/cli/streams.h"
#include "app/document/json.h"
#include "app/document/words.h"
#include "app/edit/distance_from_input.h"
#include "engine/analysis/hausdorff.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/format.h"
#include "engine/io/losses.h"
#include "engine/mesh/normals.h"
#include "engine/progressive/build.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

/// The input in all its levels.
struct Source {
  LoadedModel loaded;  ///< in full detail
  /// Its sources are empty if it was read from a file. It is empty if parts are pruned.
  progressive::Progressive progressive;
  double diagonal() const { return loaded.statistics.box.diagonal(); }
};

struct Level {
  std::uint32_t level = 0;  ///< of the progressive mesh; otherwise index of the first equal level
  Mesh mesh;
  Attributes attributes;
  std::optional<SimplifyOutcome> outcome;  ///< none if it comes from the progressive mesh
};

/// All levels, with what is reported of them.
struct Levels {
  std::vector<Level> shapes;
  LodReport report;
};

/// Returns whether level i equals the level before it, because its target cannot be reached.
bool repeats(const std::vector<Level>& levels, std::size_t i) {
  return i > 0 && levels[i].level == levels[i - 1].level;
}

std::vector<fs::path> files_for(const fs::path& output, std::size_t levels, bool is_separate) {
  if (io::writable_format(output).write_levels != nullptr && !is_separate) return {output};
  refuse_stream(output.string(), "one file per level");
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < levels; ++i)
    files.push_back(level_file(output, i));
  return files;
}

/// Returns whether each level is simplified separately. A progressive mesh cannot remove parts, and
/// its levels are not known to be within an error.
bool is_one_by_one(const Model& model, const std::vector<LodTarget>& targets,
                   const LodArguments& arguments) {
  return arguments.simplify.prune || !targets.front().ratio ||
         (!arguments.simplify.keeps_cards && has_loose_cards(model, {}));
}

/// Simplifies the model to the coarsest level, or uses the progressive mesh that was read.
void make_progressive(Source& source, LoadedLevels& opened, double least_ratio,
                      const LodArguments& arguments, const CommonOptions& common) {
  if (opened.levels) {
    source.progressive.mesh = std::move(*opened.levels);
    source.progressive.attributes = std::move(opened.attributes);
    return;
  }
  const Mesh& mesh = source.loaded.model.mesh;
  simplify::SimplifyOptions options = lod_options(
      arguments, faces_for(least_ratio, mesh.face_count()), mesh.face_count(), source.diagonal());
  ProgressLine line(!common.quiet);
  begin_stage(line.progress(), "simplifying");
  options.progress = line.progress();
  options.certifies = false;  // each level is certified for itself
  source.progressive = progressive::make_progressive(mesh, source.loaded.model.attributes, options);
}

LodLevel facts_of(const Mesh& mesh, const LodTarget& target, std::uint32_t full_faces) {
  return {.ratio = target.ratio.value_or(1.0),
          .asked_faces = target.ratio ? faces_for(*target.ratio, full_faces) : 0,
          .vertices = mesh.vertex_count(),
          .faces = mesh.face_count()};
}

/// Returns a certified bound of the distance of a level, if it was asked for; otherwise -1.
double bound_of(const Mesh& full, const Mesh& level, const LodArguments& arguments,
                const CommonOptions& common) {
  if (!arguments.simplify.bound || level.face_count() == 0) return -1.0;
  ProgressLine line(!common.quiet);
  begin_stage(line.progress(), "measuring");
  const analysis::HausdorffOptions options{.ratio = simplify::bound_ratio(full.face_count()),
                                           .progress = line.progress()};
  return analysis::hausdorff_bounds(full, level, options).two_sided().upper;
}

/// Leaves the progressive mesh at the coarsest of these levels.
void take_levels(Source& source, const std::vector<LodTarget>& targets,
                 const LodArguments& arguments, const CommonOptions& common, Levels& levels) {
  progressive::ProgressiveMesh& progressive = source.progressive.mesh;
  const Model& full = source.loaded.model;
  for (const LodTarget& target : targets) {
    const std::uint32_t asked = faces_for(*target.ratio, progressive.full_face_count());
    Level level{.level = progressive.level_for_faces(asked)};
    if (level.level == progressive.split_count()) {
      level.mesh = full.mesh;
      level.attributes = full.attributes;
    } else {
      progressive.go_to(level.level);
      level.mesh = progressive.mesh();
      progressive::ProgressiveAttributes& attributes = source.progressive.attributes;
      if (!attributes.is_empty()) {
        attributes.go_to(level.level);
        level.attributes = attributes.at_level(level.mesh);
      }
    }
    LodLevel facts = facts_of(level.mesh, target, progressive.full_face_count());
    if (level.level != progressive.split_count()) {
      facts.rms = distance_from_input(full.mesh, level.mesh);
      facts.bound = bound_of(full.mesh, level.mesh, arguments, common);
    } else {
      facts.bound = 0.0;
    }
    levels.report.levels.push_back(facts);
    levels.shapes.push_back(std::move(level));
  }
}

bool is_same(const Mesh& a, const Mesh& b) {
  return std::ranges::equal(a.origins(), b.origins()) &&
         std::ranges::equal(a.positions(), b.positions());
}

/// Simplifies the model to one level.
Level make_level(const Source& source, const LodTarget& target, const LodArguments& arguments,
                 const CommonOptions& common) {
  const Model& full = source.loaded.model;
  const std::uint32_t faces = full.mesh.face_count();
  if (target.is_full()) return {.mesh = full.mesh, .attributes = full.attributes};
  simplify::SimplifyOptions options =
      target.ratio
          ? lod_options(arguments, faces_for(*target.ratio, faces), faces, source.diagonal())
          : lod_options_within(arguments, target.max_error);
  ProgressLine line(!common.quiet);
  begin_stage(line.progress(), "simplifying");
  options.progress = line.progress();
  Model model;
  model.mesh = full.mesh;
  model.attributes = full.attributes;
  SimplifyOutcome outcome =
      reduce_model(model, options, arguments.simplify.prune, arguments.simplify.keeps_cards);
  outcome.diagonal = source.diagonal();
  return {
      .mesh = std::move(model.mesh), .attributes = std::move(model.attributes), .outcome = outcome};
}

/// Simplifies once per level.
void make_levels(const Source& source, const std::vector<LodTarget>& targets,
                 const LodArguments& arguments, const CommonOptions& common, Levels& levels) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Level level = make_level(source, targets[i], arguments, common);
    const bool repeats = i > 0 && is_same(level.mesh, levels.shapes.back().mesh);
    level.level = repeats ? levels.shapes.back().level : static_cast<std::uint32_t>(i);
    LodLevel facts = facts_of(level.mesh, targets[i], source.loaded.model.mesh.face_count());
    if (level.outcome) {
      facts.rms = level.outcome->report.estimated_error;
      facts.bound = level.outcome->report.certified_bound;
      facts.cards = level.outcome->cards;
    } else {
      facts.bound = 0.0;
    }
    levels.report.levels.push_back(facts);
    levels.shapes.push_back(std::move(level));
  }
}

/// Writes either all files or none. Separate files get a manifest.
void write_levels(const fs::path& output, const std::vector<fs::path>& files, const Levels& levels,
                  const Source& source, const CommonOptions& common) {
  std::vector<std::unique_ptr<io::AtomicFile>> open;
  open.reserve(files.size() + 1);
  for (const fs::path& file : files)
    open.push_back(std::make_unique<io::AtomicFile>(file));
  const Model& model = source.loaded.model;
  const io::FormatInfo& format = io::writable_format(files.front());
  const io::WriteOptions options{
      .compresses = common.compresses, .origin = model.origin, .materials = model.materials};
  if (files.front() == output) {
    std::vector<io::GltfLevel> chain;
    chain.reserve(levels.shapes.size());
    for (std::size_t i = 0; i < levels.shapes.size(); ++i) {
      const Level& level = levels.shapes[i];
      chain.push_back({&level.mesh, &level.attributes, levels.report.levels[i].coverage});
    }
    format.write_levels(*open.front(), chain, options);
  } else {
    for (std::size_t i = 0; i < files.size(); ++i)
      format.write(*open[i], levels.shapes[i].mesh, levels.shapes[i].attributes, options);
    open.push_back(std::make_unique<io::AtomicFile>(manifest_file(output)));
    write_manifest(*open.back(), levels.report, files, source.loaded.file);
  }
  io::AtomicFile::commit_all(open, common.flush());
}

void say_levels(const Source& source, const Levels& levels, const LodArguments& arguments) {
  const simplify::SimplifyReport& report = source.progressive.report;
  for (std::size_t i = 0; i < levels.shapes.size(); ++i) {
    const Level& level = levels.shapes[i];
    const auto reason = level.outcome ? level.outcome->report.reason : report.reason;
    const bool is_read = source.loaded.pm && !level.outcome;
    const std::string why = is_read ? "it is the base of the progressive mesh" : stop_text(reason);
    say(level_text(levels.report, i, why) +
        (repeats(levels.shapes, i) ? fmt::format("; the same mesh as level {}", i - 1) : ""));
    if (level.outcome && arguments.simplify.prune)
      say(fmt::format("level {}: {}", i, pruned_words(*level.outcome)));
    say_rest_of_level(levels.report, i);
  }
}

/// Null if the levels come from a progressive mesh that was read.
Json stop_reason(const Source& source, const Level& coarsest) {
  if (coarsest.outcome) return key(coarsest.outcome->report.reason);
  return source.loaded.pm ? Json() : Json(key(source.progressive.report.reason));
}

void print_levels(const Source& source, const std::string& output, const Levels& levels,
                  const std::vector<fs::path>& files, const std::vector<std::string>& losses) {
  Json json{{"input", source.loaded.file.string()},
            {"output", output},
            {"files", Json::array()},
            {"manifest", files.front() == output ? Json() : Json(manifest_file(output).string())},
            {"faces_before", source.loaded.model.mesh.face_count()},
            {"stop_reason", stop_reason(source, levels.shapes.back())},
            {"screen", screen_json(levels.report.screen, levels.report.diagonal)},
            {"levels", Json::array()}};
  for (const fs::path& file : files)
    json["files"].push_back(file.string());
  for (std::size_t i = 0; i < levels.shapes.size(); ++i) {
    Json level = level_json(levels.report, i);
    const auto& outcome = levels.shapes[i].outcome;
    level["pruned"] = outcome ? to_json(*outcome)["pruned"] : Json();
    level["repeats_previous"] = repeats(levels.shapes, i);
    json["levels"].push_back(std::move(level));
  }
  json["lost"] = losses;
  json["repairs"] = to_json(source.loaded.model.report);
  add_pm(json, source.loaded.pm);
  print_json(json);
}

}  // namespace

fs::path level_file(const fs::path& output, std::size_t level) {
  fs::path file = output.parent_path() / output.stem();
  file += fmt::format("_lod{}", level);
  file += output.extension();
  return file;
}

fs::path manifest_file(const fs::path& output) {
  fs::path file = output.parent_path() / output.stem();
  file += ".json";
  return file;
}

void run_lods(const InputOptions& input, const std::string& output, const LodArguments& arguments,
              const CommonOptions& common) {
  const std::size_t count = lod_targets(arguments, 1.0).size();  // refuses bad arguments
  if (!arguments.coverage.empty()) parse_coverage(arguments.coverage, count);
  check_format(output);
  const std::vector<fs::path> files = files_for(output, count, arguments.is_separate);
  for (const fs::path& file : files)
    io::AtomicFile::check(file);
  if (files.front() != output) io::AtomicFile::check(manifest_file(output));
  if (keeps_scene(input, output, common))
    return write_scene_lods(input, output, files, arguments, common);
  LoadedLevels opened = load_levels(input, common);
  Source source{std::move(opened.loaded), {}};
  const Model& model = source.loaded.model;
  if (model.mesh.face_count() == 0)
    throw InputError(source.loaded.file.string(), 0, "has no faces");
  const std::vector<LodTarget> targets = lod_targets(arguments, source.diagonal());
  Levels levels{.report = {.screen = arguments.screen, .diagonal = source.diagonal()}};
  if (is_one_by_one(model, targets, arguments)) {
    make_levels(source, targets, arguments, common, levels);
  } else {
    make_progressive(source, opened, *targets.back().ratio, arguments, common);
    take_levels(source, targets, arguments, common, levels);
  }
  set_coverage(levels.report.levels, arguments, model.mesh.face_count());
  write_levels(output, files, levels, source, common);
  const Level& finest = levels.shapes.front();
  const std::vector<std::string> losses = io::losses_in_format(
      output, finest.mesh, finest.attributes, model.materials.get(), model.contents, model.origin);
  if (!common.quiet) {
    say_losses(output, losses);
    say_levels(source, levels, arguments);
    for (const fs::path& file : files)
      say("wrote " + file.string());
    if (files.front() != output) say("wrote " + manifest_file(output).string());
  }
  if (common.json) print_levels(source, output, levels, files, losses);
}

}  // namespace mesher::app
