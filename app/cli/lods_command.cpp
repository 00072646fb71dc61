#include "app/cli/lods_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/format.h"
#include "engine/io/losses.h"
#include "engine/mesh/normals.h"
#include "engine/progressive/build.h"
#include "engine/simplify/attributes.h"
#include "engine/simplify/prune.h"

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
  LodLevel facts;
  std::uint32_t level = 0;  ///< of the progressive mesh; pruned: index of the first equal level
  Mesh mesh;
  Attributes attributes;
  std::optional<SimplifyOutcome> pruned;  ///< none unless parts may be pruned
};

/// Returns whether level i equals the level before it, because its target cannot be reached.
bool repeats(const std::vector<Level>& levels, std::size_t i) {
  return i > 0 && levels[i].level == levels[i - 1].level;
}

bool is_falling(const std::vector<double>& values) {
  return std::ranges::adjacent_find(values, std::less_equal<>()) == values.end();
}

std::vector<fs::path> files_for(const fs::path& output, std::size_t levels) {
  if (io::writable_format(output).write_levels != nullptr) return {output};
  refuse_stream(output.string(), "one file per level");
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < levels; ++i)
    files.push_back(level_file(output, i));
  return files;
}

/// Reads the model and, unless parts are pruned, builds its progressive mesh.
Source read_source(const InputOptions& input, double least_ratio, const LodArguments& arguments,
                   const CommonOptions& common) {
  LoadedLevels opened = load_levels(input, common);
  Source source{std::move(opened.loaded), {}};
  const Mesh& mesh = source.loaded.model.mesh;
  if (mesh.face_count() == 0) throw InputError(source.loaded.file.string(), 0, "has no faces");
  if (arguments.simplify.prune) return source;
  if (opened.levels) {
    source.progressive.mesh = std::move(*opened.levels);
    return source;
  }
  simplify::SimplifyOptions options = lod_options(
      arguments, faces_for(least_ratio, mesh.face_count()), mesh.face_count(), source.diagonal());
  ProgressLine line(!common.quiet);
  begin_stage(line.progress(), "simplifying");
  options.progress = line.progress();
  Mesh marked = mesh;
  simplify::mark_seams(marked, source.loaded.model.attributes);
  source.progressive = progressive::make_progressive(marked, options);
  return source;
}

/// Returns the attributes of `mesh`, a level of the source.
Attributes attributes_of(const Source& source, const Mesh& mesh) {
  const Model& full = source.loaded.model;
  if (full.attributes.is_empty()) return {};
  Array<Face> face_source(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    face_source[f] = Mesh::face(source.progressive.face_source[f]);
  return simplify::carry_attributes({full.mesh, full.attributes}, mesh, face_source);
}

LodLevel facts_of(const Mesh& mesh, double ratio, double coverage, std::uint32_t asked_faces) {
  return {.ratio = ratio,
          .coverage = coverage,
          .asked_faces = asked_faces,
          .vertices = mesh.vertex_count(),
          .faces = mesh.face_count()};
}

/// Leaves the progressive mesh at the coarsest of these levels.
std::vector<Level> make_levels(Source& source, const std::vector<double>& ratios,
                               const std::vector<double>& coverage) {
  progressive::ProgressiveMesh& progressive = source.progressive.mesh;
  std::vector<Level> levels;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const std::uint32_t asked = faces_for(ratios[i], progressive.full_face_count());
    Level level{.level = progressive.level_for_faces(asked)};
    if (level.level == progressive.split_count()) {
      level.mesh = source.loaded.model.mesh;
      level.attributes = source.loaded.model.attributes;
    } else {
      progressive.go_to(level.level);
      level.mesh = progressive.mesh();
      simplify::unmark_seams(level.mesh);
      level.attributes = attributes_of(source, level.mesh);
    }
    level.facts = facts_of(level.mesh, ratios[i], coverage[i], asked);
    levels.push_back(std::move(level));
  }
  return levels;
}

bool is_same(const Mesh& a, const Mesh& b) {
  return std::ranges::equal(a.origins(), b.origins()) &&
         std::ranges::equal(a.positions(), b.positions());
}

/// Simplifies once per level, because a progressive mesh cannot remove parts.
std::vector<Level> make_pruned_levels(const Source& source, const std::vector<double>& ratios,
                                      const std::vector<double>& coverage,
                                      const LodArguments& arguments, const CommonOptions& common) {
  const Model& full = source.loaded.model;
  std::vector<Level> levels;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    Level level;
    const std::uint32_t asked = faces_for(ratios[i], full.mesh.face_count());
    simplify::SimplifyOptions options =
        lod_options(arguments, asked, full.mesh.face_count(), source.diagonal());
    ProgressLine line(!common.quiet);
    begin_stage(line.progress(), "simplifying");
    options.progress = line.progress();
    auto [simplified, carried, crosses_seams] =
        simplify::simplify_model(Mesh(full.mesh), full.attributes, options, true);
    level.attributes = std::move(carried);
    level.pruned = SimplifyOutcome{simplified.report, source.diagonal(), crosses_seams};
    level.mesh = std::move(simplified.mesh);
    const bool repeats = i > 0 && is_same(level.mesh, levels.back().mesh);
    level.level = repeats ? levels.back().level : static_cast<std::uint32_t>(i);
    level.facts = facts_of(level.mesh, ratios[i], coverage[i], asked);
    levels.push_back(std::move(level));
  }
  return levels;
}

/// Starts with the coarsest level: if one is near the model, the finer ones are near as well.
void measure_coarse_levels(const Source& source, std::vector<Level>& levels) {
  for (std::size_t i = levels.size(); i-- > 0;) {
    const double error = distance_from_input(source.loaded.model.mesh, levels[i].mesh);
    if (error <= simplify::kFarFromInput * source.diagonal()) return;
    levels[i].facts.error = error;
  }
}

/// Writes either all files or none.
void write_levels(const std::vector<fs::path>& files, const std::vector<Level>& levels,
                  const Model& model, const CommonOptions& common) {
  std::vector<std::unique_ptr<io::AtomicFile>> open;
  open.reserve(files.size());
  for (const fs::path& file : files)
    open.push_back(std::make_unique<io::AtomicFile>(file));
  const io::FormatInfo& format = io::writable_format(files.front());
  const io::WriteOptions options{
      .compresses = common.compresses, .origin = model.origin, .materials = model.materials};
  if (format.write_levels != nullptr) {
    std::vector<io::GltfLevel> chain;
    chain.reserve(levels.size());
    for (const Level& level : levels)
      chain.push_back({&level.mesh, &level.attributes, level.facts.coverage});
    format.write_levels(*open.front(), chain, options);
  } else {
    for (std::size_t i = 0; i < levels.size(); ++i)
      format.write(*open[i], levels[i].mesh, levels[i].attributes, options);
  }
  io::AtomicFile::commit_all(open, common.flush());
}

void say_levels(const Source& source, const std::vector<Level>& levels,
                const std::vector<fs::path>& files) {
  const simplify::SimplifyReport& report = source.progressive.report;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const Level& level = levels[i];
    const simplify::StopReason reason = level.pruned ? level.pruned->report.reason : report.reason;
    const bool is_read = source.loaded.pm && !level.pruned;
    const std::string why = is_read ? "it is the base of the progressive mesh" : stop_text(reason);
    say(level_text(i, level.facts, why) +
        (repeats(levels, i) ? fmt::format("; the same mesh as level {}", i - 1) : ""));
    if (level.pruned) say(fmt::format("level {}: {}", i, pruned_words(*level.pruned)));
    warn_if_far(i, level.facts, source.diagonal());
  }
  for (const fs::path& file : files)
    say("wrote " + file.string());
}

/// Null if the levels come from a progressive mesh that was read.
Json stop_reason(const Source& source, const Level& coarsest) {
  if (coarsest.pruned) return key(coarsest.pruned->report.reason);
  return source.loaded.pm ? Json() : Json(key(source.progressive.report.reason));
}

void print_levels(const Source& source, const std::string& output, const std::vector<Level>& levels,
                  const std::vector<fs::path>& files, const std::vector<std::string>& losses) {
  Json json{{"input", source.loaded.file.string()},
            {"output", output},
            {"files", Json::array()},
            {"faces_before", source.loaded.model.mesh.face_count()},
            {"stop_reason", stop_reason(source, levels.back())},
            {"levels", Json::array()}};
  for (const fs::path& file : files)
    json["files"].push_back(file.string());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    Json level = level_json(levels[i].facts);
    level["pruned"] = levels[i].pruned ? to_json(*levels[i].pruned)["pruned"] : Json();
    level["repeats_previous"] = repeats(levels, i);
    json["levels"].push_back(std::move(level));
  }
  json["lost"] = losses;
  json["repairs"] = to_json(source.loaded.model.report);
  add_pm(json, source.loaded.pm);
  print_json(json);
}

}  // namespace

std::vector<double> parse_ratios(const std::string& text) {
  const std::vector<double> ratios = parse_numbers(text).value_or(std::vector<double>{});
  if (ratios.empty() || !is_falling(ratios) || ratios.front() > 1.0 || ratios.back() <= 0.0) {
    throw UsageError("--ratios: '" + text +
                     "' is not a decreasing list of numbers above 0 and at most 1, such as "
                     "1,0.5,0.25");
  }
  return ratios;
}

std::vector<double> parse_coverage(const std::string& text, std::size_t levels) {
  const std::vector<double> coverage = parse_numbers(text).value_or(std::vector<double>{});
  if (coverage.size() != levels || !is_falling(coverage) || coverage.front() > 1.0 ||
      coverage.back() < 0.0) {
    throw UsageError(fmt::format(
        "--coverage: '{}' is not a decreasing list of {} numbers from 0 to 1, one per level", text,
        levels));
  }
  return coverage;
}

std::vector<double> default_coverage(const std::vector<double>& ratios) {
  std::vector<double> coverage(ratios.begin() + 1, ratios.end());
  coverage.push_back(0.0);
  return coverage;
}

fs::path level_file(const fs::path& output, std::size_t level) {
  fs::path file = output.parent_path() / output.stem();
  file += fmt::format("_lod{}", level);
  file += output.extension();
  return file;
}

void run_lods(const InputOptions& input, const std::string& output, const LodArguments& arguments,
              const CommonOptions& common) {
  const std::vector<double> ratios = parse_ratios(arguments.ratios.value_or(kUsualRatios));
  const std::vector<double> coverage = arguments.coverage.empty()
                                           ? default_coverage(ratios)
                                           : parse_coverage(arguments.coverage, ratios.size());
  check_format(output);
  const std::vector<fs::path> files = files_for(output, ratios.size());
  for (const fs::path& file : files)
    io::AtomicFile::check(file);
  if (keeps_scene(input, output, common))
    return write_scene_lods(input, output, ratios, coverage, arguments, common);
  Source source = read_source(input, ratios.back(), arguments, common);
  std::vector<Level> levels = arguments.simplify.prune
                                  ? make_pruned_levels(source, ratios, coverage, arguments, common)
                                  : make_levels(source, ratios, coverage);
  measure_coarse_levels(source, levels);
  write_levels(files, levels, source.loaded.model, common);
  const std::vector<std::string> losses = io::losses_in_format(
      output, levels.front().mesh, levels.front().attributes, source.loaded.model.materials.get(),
      source.loaded.model.contents, source.loaded.model.origin);
  if (!common.quiet) {
    say_losses(output, losses);
    say_levels(source, levels, files);
  }
  if (common.json) print_levels(source, output, levels, files, losses);
}

}  // namespace mesher::app
