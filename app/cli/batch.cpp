#include "app/cli/batch.h"

#include <glm/trigonometric.hpp>
#include <iomanip>
#include <iostream>

#include "app/cli/progress_line.h"
#include "app/document/words.h"
#include "app/files/paths.h"
#include "engine/analysis/self_intersections.h"
#include "engine/core/error.h"
#include "engine/io/atomic_file.h"
#include "engine/io/format.h"
#include "engine/io/losses.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "engine/mesh/creases.h"

namespace mesher::app {
namespace {

void print(const char* label, const std::string& value) {
  std::cout << std::left << std::setw(19) << label << value << '\n';
}

void print(const char* label, std::int64_t value) {
  print(label, std::to_string(value));
}

std::string size_text(const Box& box) {
  if (box.is_empty()) return "empty";
  const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
  return short_number(size.x) + " x " + short_number(size.y) + " x " + short_number(size.z) +
         ", diagonal " + short_number(box.diagonal());
}

void print_statistics(const Statistics& s) {
  print("vertices", s.vertices);
  print("edges", s.edges);
  print("faces", s.faces);
  print("boundary edges", s.boundary_edges);
  print("boundary loops", s.boundary_loops);
  print("components", s.components);
  print("Euler char.", s.euler_characteristic);
  print("crease edges", s.crease_edges);
  if (s.isolated_vertices > 0) print("isolated vertices", s.isolated_vertices);
  if (s.zero_area_faces > 0) print("zero-area faces", s.zero_area_faces);
  print("size", size_text(s.box));
  print("area", short_number(s.area));
  if (s.is_closed()) print("volume", short_number(s.volume));
}

void say_repairs(const BuildReport& report) {
  for (std::size_t i = 0; i < kRepairs.size(); ++i) {
    const auto repair = static_cast<Repair>(i);
    if (report[repair] == 0) continue;
    std::cerr << "mesher: " << report[repair] << ' ' << describe(repair) << '\n';
  }
}

/// Prints even with --quiet, because the result is not the complete model.
void say_damage(const LoadedModel& loaded) {
  if (loaded.pm->damage.empty()) return;
  say(loaded.file.string() + ": DAMAGED: " + loaded.pm->damage +
      "; using the intact part before it: " + with_commas(loaded.pm->faces) + " faces");
}

void print_pm(const io::PmSummary& pm) {
  print("progressive mesh", pm.coordinate_bits == 0
                                ? std::string("lossless")
                                : std::to_string(pm.coordinate_bits) + "-bit positions");
  print("base vertices", pm.base_vertices);
  print("base faces", pm.base_faces);
  print("splits", pm.splits);
  print("bytes",
        with_commas(pm.bytes) + ", " + short_number(pm.bytes_per_vertex()) + " per vertex");
  print("complete", pm.damage.empty() ? "yes" : "no: " + pm.damage);
}

Json model_json(const LoadedModel& loaded) {
  Json json = to_json(loaded.model, loaded.statistics, loaded.file);
  add_pm(json, loaded.pm);
  return json;
}

}  // namespace

void print_json(const Json& json) {
  std::cout << to_text(json) << '\n';
}

void add_pm(Json& json, const std::optional<io::PmSummary>& pm, const char* key) {
  if (pm) json[key] = to_json(*pm);
}

void say(const std::string& words) {
  std::cerr << "mesher: " << words << '\n';
}

void check_format(const std::string& output) {
  io::writable_format(output);
}

void check_output(const std::string& output) {
  check_format(output);
  io::AtomicFile::check(output);
}

std::vector<std::string> write_result(const std::string& output, const Model& model,
                                      const CommonOptions& common) {
  const std::vector<std::string> losses =
      io::losses_in_format(output, model.mesh, model.attributes);
  io::write_model(output, model.mesh, model.attributes);
  if (!common.quiet) {
    const std::string cannot_hold = output + " cannot hold ";
    for (const std::string& loss : losses)
      say(cannot_hold + loss);
    say(output + ": " + with_commas(model.mesh.vertex_count()) + " vertices, " +
        with_commas(model.mesh.face_count()) + " faces");
  }
  return losses;
}

LoadedModel load(const InputOptions& input, const CommonOptions& common) {
  LoadedModel loaded;
  {
    ProgressLine line(!common.quiet);
    loaded = open_model(find_model(input.model), {.crease_index_base = input.crease_index_base,
                                                  .keep_isolated_vertices = input.keep_isolated,
                                                  .progress = line.progress()});
    if (input.tag_creases_deg) {
      tag_creases_by_angle(loaded.model.mesh, glm::radians(*input.tag_creases_deg));
    }
    loaded.statistics = statistics(loaded.model.mesh);
  }
  if (!common.quiet) say_repairs(loaded.model.report);
  if (loaded.pm) say_damage(loaded);
  return loaded;
}

LoadedLevels load_levels(const InputOptions& input, const CommonOptions& common) {
  const std::filesystem::path file = find_model(input.model);
  if (!io::is_pm_file(file)) return {load(input, common), {}};
  if (input.tag_creases_deg) {
    throw UsageError(
        "--tag-creases: cannot be used with a progressive mesh, which keeps the creases of the "
        "model that it was built from");
  }
  ProgressLine line(!common.quiet);
  io::PmContents contents = io::read_pm_file(file, line.progress());
  LoadedModel loaded{{}, {}, file, std::move(contents.summary)};
  loaded.model.name = file.filename().string();
  loaded.model.mesh = contents.mesh.mesh();
  loaded.statistics = statistics(loaded.model.mesh);
  say_damage(loaded);
  return {std::move(loaded), std::move(contents.mesh)};
}

void run_info(const InputOptions& input, const CommonOptions& common) {
  const LoadedModel loaded = load(input, common);
  if (common.json) return print_json(model_json(loaded));
  print("file", loaded.file.string());
  if (loaded.pm) print_pm(*loaded.pm);
  print_statistics(loaded.statistics);
  if (loaded.model.report.is_clean()) print("repairs", "none needed");
}

void run_convert(const InputOptions& input, const std::string& output, bool ascii,
                 const CommonOptions& common) {
  check_output(output);
  const LoadedModel loaded = load(input, common);
  const Mesh& mesh = loaded.model.mesh;
  // Most formats cannot represent an empty mesh, and their readers would reject one.
  if (mesh.face_count() == 0) throw InputError(loaded.file.string(), 0, "has no faces to convert");
  const std::vector<std::string> losses =
      io::losses_in_format(output, mesh, loaded.model.attributes);
  io::write_model(output, mesh, loaded.model.attributes, {.ascii = ascii});
  if (!common.quiet) {
    for (const std::string& loss : losses) {
      std::cerr << "mesher: " << output << " cannot hold " << loss << '\n';
    }
    std::cerr << "mesher: " << output << ": " << mesh.vertex_count() << " vertices, "
              << mesh.face_count() << " faces\n";
  }
  if (common.json) {
    Json json = model_json(loaded);
    json["output"] = output;
    json["lost"] = losses;
    print_json(json);
  }
}

void run_compare(const InputOptions& first, const InputOptions& second, std::uint64_t samples,
                 const CommonOptions& common) {
  const LoadedModel a = load(first, common);
  const LoadedModel b = load(second, common);
  for (const LoadedModel* model : {&a, &b}) {
    if (model->statistics.faces == 0) {
      throw InputError(model->file.string(), 0, "has no faces to compare");
    }
  }
  analysis::SurfaceDistance distance;
  std::uint64_t first_pairs = 0;
  std::uint64_t second_pairs = 0;
  analysis::DistanceInterval certified;
  {
    ProgressLine line(!common.quiet);
    certified =
        analysis::hausdorff_bounds(a.model.mesh, b.model.mesh, {.progress = line.progress()})
            .two_sided();
    distance = analysis::surface_distance(a.model.mesh, b.model.mesh,
                                          {.samples = samples, .progress = line.progress()});
    first_pairs = analysis::count_self_intersections(a.model.mesh, line.progress());
    second_pairs = analysis::count_self_intersections(b.model.mesh, line.progress());
  }
  if (common.json) {
    Json json = to_json(distance, certified);
    json["first"] = a.file.string();
    json["second"] = b.file.string();
    json["samples"] = samples;
    json["first_self_intersections"] = first_pairs;
    json["second_self_intersections"] = second_pairs;
    add_pm(json, a.pm, "first_pm");
    add_pm(json, b.pm, "second_pm");
    return print_json(json);
  }
  const auto row = [&](const char* label, const analysis::OneSidedDistance& side) {
    print(label, "rms " + short_number(side.rms) + " (" + short_number(distance.percent(side.rms)) +
                     " %), mean " + short_number(side.mean) + ", max " + short_number(side.max) +
                     " (" + short_number(distance.percent(side.max)) + " %)");
  };
  row("first to second", distance.forward);
  row("second to first", distance.backward);
  row("two-sided", distance.two_sided());
  print("self-intersections", with_commas(first_pairs) + " pairs of faces in the first, " +
                                  with_commas(second_pairs) + " in the second");
  print("certified max", short_number(certified.lower) + " to " + short_number(certified.upper) +
                             " (" + short_number(distance.percent(certified.lower)) + " to " +
                             short_number(distance.percent(certified.upper)) + " %)");
}

}  // namespace mesher::app
