#include "app/cli/progressive_command.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "app/cli/batch.h"
#include "app/cli/progress_line.h"
#include "app/document/json.h"
#include "app/document/words.h"
#include "app/edit/distance_from_input.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/losses.h"
#include "engine/progressive/base.h"
#include "engine/progressive/build.h"
#include "engine/simplify/seams.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

/// Returns whether the output needs no ".pm" in its name: a pipe, or a file that the shell opened.
bool is_stream(const fs::path& file) {
  if (file == "/dev/stdout" || file.parent_path() == "/dev/fd") return true;
  std::error_code ignored;
  return fs::exists(file, ignored) && !fs::is_regular_file(file, ignored) &&
         !fs::is_directory(file, ignored);
}

void check_pm_output(const std::string& output) {
  if (!io::has_pm_ending(output) && !is_stream(output)) {
    throw UsageError("-o: '" + output + "' does not end in .pm");
  }
  io::AtomicFile::check(output);
}

/// What was built and written.
struct Written {
  SimplifyOutcome outcome;
  std::vector<std::string> losses;  ///< what the file does not hold of the input
  io::PmSummary summary;
  progressive::PmSizes sizes;
  double build_s = 0.0;
  double write_s = 0.0;
};

/// Times of building the progressive mesh, and of writing it: 0.1, 1.4 and 13 million faces.
constexpr double kMakeAndWriteWeights[] = {0.56, 0.44};

class Stopwatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(begin_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

Written make_and_write(const LoadedModel& loaded, const std::string& output,
                       simplify::SimplifyOptions simple, unsigned coordinate_bits,
                       const CommonOptions& common) {
  ProgressLine line(!common.quiet);
  Stages stages(line.progress(), kMakeAndWriteWeights);
  stages.next();
  simple.progress = line.progress();
  Stopwatch watch;
  const Model& model = loaded.model;
  progressive::Progressive made =
      progressive::make_progressive(model.mesh, model.attributes, simple);
  Written written;
  written.outcome = {made.report, loaded.statistics.box.diagonal()};
  written.losses = io::losses_in_format("x.pm", loaded.model.mesh, loaded.model.attributes,
                                        loaded.model.materials.get(), loaded.model.contents,
                                        loaded.model.origin);
  written.build_s = std::max(0.0, watch.lap() - made.report.seconds.total());
  stages.next();
  const progressive::PmWriteOptions options{.coordinate_bits = coordinate_bits,
                                            .attributes = &made.attributes,
                                            .progress = line.progress()};
  io::AtomicFile file(output);
  written.sizes = io::write_pm_file(file, made.mesh, options, model.materials.get());
  file.commit(common.flush());
  written.write_s = watch.lap();
  written.summary = io::summary_of(made.mesh, options, written.sizes);
  return written;
}

double share_of_indexed(const io::PmSummary& pm) {
  return pm.indexed_bytes() > 0 ? double(pm.bytes) / double(pm.indexed_bytes()) : 0.0;
}

/// A part of the file.
struct Part {
  std::string name;
  std::uint64_t bytes = 0;
  double bits_per_vertex = 0.0;
  std::string precision;
};

/// Returns the parts of a file with attributes; none if it has none.
std::vector<Part> parts_of(const Written& written) {
  const progressive::PmSizes& sizes = written.sizes;
  std::vector<Part> parts;
  if (sizes.attributes == 0) return parts;
  const auto add = [&](const std::string& name, std::uint64_t bytes, const std::string& precision) {
    const double vertices = std::max(written.summary.vertices, 1U);
    parts.push_back({name, bytes, 8.0 * double(bytes) / vertices, precision});
  };
  const auto precision = [](unsigned bits) {
    return bits == 0 ? std::string("lossless") : fmt::format("{} bits per number", bits);
  };
  add("mesh", sizes.geometry(), precision(written.summary.coordinate_bits));
  for (const progressive::PmLayerSize& layer : sizes.layers)
    add(layer.name, layer.bytes, precision(layer.bits));
  if (!sizes.layers.empty()) add("seams", sizes.wedges, "lossless");
  if (sizes.groups > 0) add("groups", sizes.groups, "lossless");
  if (sizes.appendix > 0) add("materials", sizes.appendix, "as they are");
  return parts;
}

void say_written(const std::string& output, const Written& written) {
  const simplify::SimplifyReport& r = written.outcome.report;
  const io::PmSummary& pm = written.summary;
  say(fmt::format(
      "base: {} of {}, {}: {}; {}, in {}", count_text(pm.base_faces),
      count_text(r.faces_before, "face"),
      r.faces_asked > 0 ? "asked for " + count_text(r.faces_asked) : "chosen by size and error",
      stop_text(r.reason), count_text(pm.splits, "split"),
      seconds_text(r.seconds.total() + written.build_s)));
  say(fmt::format("estimated error of the base (RMS): {} of the diagonal",
                  percent_text(written.outcome.error_percent())));
  if (written.outcome.is_far()) {
    say(r.faces_asked > 0 ? "warning: the base is far from the input; give a larger --base-faces "
                            "to keep its shape"
                          : "warning: the base is far from the input, which has few faces");
  }
  say(fmt::format(
      "{}: {} in {}, {} per vertex ({}), {} of the plain arrays; the base takes {}", output,
      count_text(pm.bytes, "byte"), seconds_text(written.write_s),
      number_text(pm.bytes_per_vertex()),
      pm.coordinate_bits == 0 ? "lossless" : fmt::format("{}-bit positions", pm.coordinate_bits),
      percent_text(100.0 * share_of_indexed(pm)), count_text(written.sizes.base, "byte")));
  for (const Part& part : parts_of(written))
    say(fmt::format("{}: {} bits per vertex ({})", part.name, number_text(part.bits_per_vertex),
                    part.precision));
  say_losses(output, written.losses);
}

void print_written(const LoadedModel& loaded, const std::string& output, const Written& written) {
  Json json{{"input", loaded.file.string()}, {"output", output}};
  json.update(to_json(written.outcome));
  json["seconds"]["build"] = written.build_s;
  json["seconds"]["write"] = written.write_s;
  add_pm(json, written.summary);
  json["pm"]["base_bytes"] = written.sizes.base;
  json["pm"]["split_bytes"] = written.sizes.splits;
  for (const Part& part : parts_of(written)) {
    json["pm"]["parts"].push_back({{"name", part.name},
                                   {"bytes", part.bytes},
                                   {"bits_per_vertex", part.bits_per_vertex},
                                   {"precision", part.precision}});
  }
  json["share_of_indexed"] = share_of_indexed(written.summary);
  json["lost"] = written.losses;
  json["repairs"] = to_json(loaded.model.report);
  add_pm(json, loaded.pm, "input_pm");
  print_json(json);
}

void say_level(const progressive::ProgressiveMesh& mesh, const DetailArguments& arguments) {
  const std::uint32_t faces = mesh.face_count(mesh.level());
  std::string why;
  if (arguments.faces && faces > *arguments.faces) why = ", the base: no level is coarser";
  if (arguments.faces && mesh.level() == mesh.split_count() && faces < *arguments.faces) {
    why = ", full detail: the mesh has no more faces";
  }
  say(fmt::format("level {} of {}{}", count_text(mesh.level()), count_text(mesh.split_count()),
                  why));
}

}  // namespace

std::uint32_t level_for(const DetailArguments& arguments,
                        const progressive::ProgressiveMesh& mesh) {
  if (arguments.faces) return mesh.level_for_faces(*arguments.faces);
  return static_cast<std::uint32_t>(std::llround(*arguments.lod * mesh.split_count()));
}

void run_progressive(const InputOptions& input, const std::string& output,
                     const ProgressiveArguments& arguments, const CommonOptions& common) {
  check_pm_output(output);
  const LoadedModel loaded = load(input, common);
  const std::uint32_t faces = loaded.model.mesh.face_count();
  if (faces == 0) throw InputError(loaded.file.string(), 0, "has no faces");
  SimplifyArguments simplify = arguments.simplify;
  const std::uint32_t base_faces = arguments.settings.base_faces;
  simplify.faces = std::max(base_faces, 1U);
  const double diagonal = loaded.statistics.box.diagonal();
  simplify::SimplifyOptions options = simplify_options(simplify, faces, diagonal);
  if (base_faces == 0)
    progressive::choose_base(options, faces, diagonal,
                             simplify::may_have_lines(loaded.model.attributes));
  Written written = make_and_write(loaded, output, options, arguments.coordinate_bits, common);
  if (base_faces == 0) written.outcome.report.faces_asked = 0;
  if (!common.quiet) say_written(output, written);
  if (common.json) print_written(loaded, output, written);
}

void run_extract(const InputOptions& input, const std::string& output,
                 const DetailArguments& arguments, const CommonOptions& common) {
  if (!arguments.faces && !arguments.lod) {
    throw UsageError("extract: give a level of detail: --faces N or --lod 0..1");
  }
  check_output(output);
  auto [loaded, levels, attributes] = load_levels(input, common);
  if (!levels) {
    throw InputError(loaded.file.string(), 0,
                     "is not a progressive mesh; `mesher progressive` writes one");
  }
  levels->go_to(level_for(arguments, *levels));
  Model& model = loaded.model;
  const auto percent = far_percent(model.mesh, levels->mesh(), loaded.statistics.box.diagonal());
  model.mesh = levels->mesh();
  attributes.go_to(attributes.is_empty() ? 0 : levels->level());
  model.attributes = attributes.at_level(model.mesh);
  if (model.mesh.face_count() == 0) throw InputError(loaded.file.string(), 0, "has no faces");
  if (!common.quiet) say_level(*levels, arguments);
  if (!common.quiet && percent) {
    say("warning: this level is " + far_from("the full detail", *percent));
  }
  const std::vector<std::string> losses = write_result(output, model, common);
  if (!common.json) return;
  Json json{{"input", loaded.file.string()},
            {"output", output},
            {"asked_faces", arguments.faces ? Json(*arguments.faces) : Json()},
            {"asked_lod", arguments.lod ? Json(*arguments.lod) : Json()},
            {"level", levels->level()},
            {"vertices", model.mesh.vertex_count()},
            {"faces", model.mesh.face_count()},
            {"far_from_input", percent.has_value()},
            {"lost", losses}};
  add_pm(json, loaded.pm);
  print_json(json);
}

}  // namespace mesher::app
