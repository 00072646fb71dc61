#include "app/cli/batch.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>
#include <iostream>

#include "app/cli/progress_line.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"
#include "app/files/paths.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/atomic_file.h"
#include "engine/io/format.h"
#include "engine/io/image_header.h"
#include "engine/io/losses.h"
#include "engine/io/pm_file.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "engine/mesh/creases.h"

namespace mesher::app {
namespace {

/// Times of reading a model, and of its statistics; measured as kLoadWeights in load_job.cpp.
constexpr double kReadAndCountWeights[] = {0.87, 0.13};
void print(const char* label, const std::string& value) {
  std::cout << fmt::format("{:<22}{}\n", label, printable(value));
}

void print(const char* label, std::int64_t value) {
  print(label, count_text(value));
}

std::string extent_text(const Box& box) {
  if (box.is_empty()) return "empty";
  const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
  return fmt::format("{} x {} x {}, diagonal {}", number_text(size.x), number_text(size.y),
                     number_text(size.z), number_text(box.diagonal()));
}

void print_statistics(const Statistics& s) {
  for (const Count& count : kCounts) {
    if (!count.hides_zero || count.of(s) > 0) print(count.label, count.of(s));
  }
  print("size", extent_text(s.box));
  print("area", number_text(s.area));
  if (s.is_closed()) print("volume", number_text(s.volume));
}

void print_origin(const glm::dvec3& origin) {
  if (origin == glm::dvec3(0.0)) return;
  print("origin", fmt::format("{} {} {} (added to all positions)", origin.x, origin.y, origin.z));
}

void print_list(const char* label, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    print(label, line);
    label = "";
  }
}

/// Returns the types of the attributes in the file; those of the model if the reader says nothing.
std::vector<std::string> attribute_texts(const Model& model) {
  if (!model.contents.attributes().empty()) return model.contents.attributes();
  std::vector<std::string> texts;
  for (const AttributeLayer& layer : model.attributes.layers)
    texts.push_back(type_text(layer.type()));
  return texts;
}

/// What `info` says of an image.
struct ImageFacts {
  std::string name;
  std::string type;
  std::optional<glm::uvec2> size;
  std::size_t bytes = 0;  ///< 0: the file is missing
};

std::vector<ImageFacts> image_facts(const Model& model) {
  std::vector<ImageFacts> facts;
  if (model.materials == nullptr) return facts;
  for (const EncodedImage& image : model.materials->images) {
    ImageFacts& fact = facts.emplace_back();
    fact.name = FileContents::readable(image.path.empty() ? image.name : image.path.string());
    fact.type = image.mime_type;
    if (image.bytes == nullptr) continue;
    const io::ImageHeader header = io::read_image_header(*image.bytes);
    if (header.width > 0 && header.height > 0) fact.size = glm::uvec2(header.width, header.height);
    fact.bytes = image.bytes->size();
  }
  return facts;
}

std::vector<std::string> texts_of(const std::vector<ImageFacts>& images) {
  std::vector<std::string> texts;
  for (const ImageFacts& image : images) {
    const std::string name = image.name.empty() ? "unnamed" : image.name;
    if (image.bytes == 0) {
      texts.push_back(name + ": missing");
      continue;
    }
    texts.push_back(
        fmt::format("{}: {}{}, {} bytes", name, image.type.empty() ? "unknown format" : image.type,
                    image.size ? fmt::format(", {} x {} pixels", image.size->x, image.size->y) : "",
                    count_text(static_cast<std::int64_t>(image.bytes))));
  }
  return texts;
}

Json images_json(const std::vector<ImageFacts>& images) {
  Json json = Json::array();
  for (const ImageFacts& image : images) {
    json.push_back({{"name", image.name},
                    {"type", image.type},
                    {"width", image.size ? Json(image.size->x) : Json()},
                    {"height", image.size ? Json(image.size->y) : Json()},
                    {"bytes", image.bytes}});
  }
  return json;
}

void print_contents(const FileContents& contents) {
  const char* label = "contents";
  for (std::size_t i = 0; i < kContents.size(); ++i) {
    const auto kind = static_cast<Content>(i);
    if (contents[kind] == 0) continue;
    print(label, contents.phrase(kind));
    label = "";
  }
}

/// Refuses a damaged file, unless its intact part will do. Says that even with --quiet, because the
/// result is not the complete model.
void check_damage(const LoadedModel& loaded, const InputOptions& input) {
  if (loaded.pm->damage.empty()) return;
  const std::string intact = count_text(loaded.pm->faces, "face");
  if (!input.allow_damaged) {
    throw InputError(
        loaded.file.string(), 0,
        fmt::format("is damaged: {}; --allow-damaged uses the intact part before it: {}",
                    loaded.pm->damage, intact));
  }
  say(fmt::format("{}: DAMAGED: {}; using the intact part before it: {}", loaded.file.string(),
                  loaded.pm->damage, intact));
}

void print_pm(const io::PmSummary& pm) {
  print("progressive mesh", pm.coordinate_bits == 0
                                ? std::string("lossless")
                                : fmt::format("{}-bit positions", pm.coordinate_bits));
  print("base vertices", pm.base_vertices);
  print("base faces", pm.base_faces);
  print("splits", pm.splits);
  print("bytes",
        fmt::format("{}, {} per vertex", count_text(pm.bytes), number_text(pm.bytes_per_vertex())));
  if (pm.attribute_bytes > 0) print("attribute bytes", count_text(pm.attribute_bytes));
  print("complete", pm.damage.empty() ? "yes" : "no: " + pm.damage);
}

void write_model(const std::string& output, const Model& model, bool ascii,
                 const CommonOptions& common) {
  ProgressLine line(!common.quiet, std::filesystem::path(output).filename().string());
  io::write_model(output, model.mesh, model.attributes,
                  {.ascii = ascii,
                   .compresses = common.compresses,
                   .origin = model.origin,
                   .materials = model.materials,
                   .progress = line.progress(),
                   .flush = common.flush()});
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
  // One write per line, so that lines of several processes do not mix.
  std::cerr << "mesher: " + printable(words) + '\n';
}

void say_repairs(const BuildReport& report) {
  for (std::size_t i = 0; i < kRepairs.size(); ++i) {
    const auto repair = static_cast<Repair>(i);
    if (report[repair] == 0) continue;
    say(count_phrase(static_cast<std::int64_t>(report[repair]), describe(repair)));
  }
}

void say_findings(const Model& model) {
  say_repairs(model.report);
  for (const std::string& warning : model.contents.warnings())
    say(warning);
}

void say_written(const std::string& output, std::uint32_t vertices, std::uint32_t faces) {
  say(fmt::format("{}: {} vertices, {}", output, count_text(vertices), count_text(faces, "face")));
}

void say_losses(const std::string& output, const std::vector<std::string>& losses) {
  for (const std::string& loss : losses)
    say(fmt::format("{} does not hold {}", output, loss));
}

void check_format(const std::string& output) {
  // A progressive mesh is built, and not just written: one command has the options for that.
  if (io::has_pm_ending(output)) {
    throw UsageError(fmt::format(
        "{}: a progressive mesh is written by `mesher progressive MODEL {}`; to write one of a "
        "changed model, write a .ply first and give that as MODEL",
        output, output));
  }
  io::writable_format(output);
}

void check_output(const std::string& output) {
  check_format(output);
  io::AtomicFile::check(output);
}

std::vector<std::string> write_result(const std::string& output, const Model& model,
                                      const CommonOptions& common) {
  const std::vector<std::string> losses = io::losses_in_format(
      output, model.mesh, model.attributes, model.materials.get(), model.contents, model.origin);
  write_model(output, model, false, common);
  if (!common.quiet) {
    say_losses(output, losses);
    say_written(output, model.mesh.vertex_count(), model.mesh.face_count());
  }
  return losses;
}

LoadedModel load(const InputOptions& input, const CommonOptions& common) {
  LoadedModel loaded;
  {
    const std::filesystem::path file = find_model(input.model);
    ProgressLine line(!common.quiet, file.filename().string());
    Stages stages(line.progress(), kReadAndCountWeights);
    stages.next();
    io::ReadOptions options = read_options(input);
    options.progress = line.progress();
    loaded = open_model(file, options);
    if (input.tag_creases_deg) {
      tag_creases_by_angle(loaded.model.mesh, glm::radians(*input.tag_creases_deg));
    }
    stages.next("counting");
    loaded.statistics = scene::statistics(loaded.model.mesh, loaded.model.attributes,
                                          loaded.model.scene.get(), line.progress());
  }
  if (loaded.pm) check_damage(loaded, input);
  if (!common.quiet) say_findings(loaded.model);
  return loaded;
}

LoadedLevels load_levels(const InputOptions& input, const CommonOptions& common) {
  const std::filesystem::path file = find_model(input.model);
  if (!io::is_pm_file(file)) return {load(input, common), {}, {}};
  if (input.tag_creases_deg) {
    throw UsageError(
        "--tag-creases: cannot be used with a progressive mesh, which keeps the creases of the "
        "model that it was built from");
  }
  ProgressLine line(!common.quiet, file.filename().string());
  io::PmContents contents = io::read_pm_file(file, line.progress());
  LoadedModel loaded{{}, {}, file, std::move(contents.summary)};
  loaded.model.name = file.filename().string();
  loaded.model.mesh = contents.mesh.mesh();
  loaded.model.attributes = contents.attributes.at_level(loaded.model.mesh);
  loaded.model.materials = std::move(contents.materials);
  loaded.model.contents = std::move(contents.contents);
  loaded.statistics = statistics(loaded.model.mesh);
  check_damage(loaded, input);
  if (!common.quiet) say_findings(loaded.model);
  return {std::move(loaded), std::move(contents.mesh), std::move(contents.attributes)};
}

void run_info(const InputOptions& input, const CommonOptions& common) {
  const LoadedModel loaded = load(input, common);
  const std::vector<std::string> attributes = attribute_texts(loaded.model);
  const std::vector<ImageFacts> images = image_facts(loaded.model);
  if (common.json) {
    Json json = model_json(loaded);
    if (!attributes.empty()) json["attributes"] = attributes;
    if (!images.empty()) json["images"] = images_json(images);
    return print_json(json);
  }
  print("file", loaded.file.string());
  if (loaded.pm) print_pm(*loaded.pm);
  print_statistics(loaded.statistics);
  print_origin(loaded.model.origin);
  print_list("attributes", attributes);
  print_list("images", texts_of(images));
  print_contents(loaded.model.contents);
  if (loaded.model.report.is_clean()) print("repairs", "none needed");
}

void run_convert(const InputOptions& input, const std::string& output, bool ascii, bool repairs,
                 const CommonOptions& common) {
  check_output(output);
  if (keeps_scene(input, output, common)) return convert_scene(input, output, repairs, common);
  const LoadedModel loaded = load(input, common);
  const Mesh& mesh = loaded.model.mesh;
  // Most formats cannot represent an empty mesh, and their readers would reject one.
  if (mesh.face_count() == 0) throw InputError(loaded.file.string(), 0, "has no faces to convert");
  const std::vector<std::string> losses =
      io::losses_in_format(output, mesh, loaded.model.attributes, loaded.model.materials.get(),
                           loaded.model.contents, loaded.model.origin);
  write_model(output, loaded.model, ascii, common);
  if (!common.quiet) {
    say_losses(output, losses);
    say_written(output, mesh.vertex_count(), mesh.face_count());
  }
  if (common.json) {
    Json json = model_json(loaded);
    json["output"] = output;
    json["lost"] = losses;
    print_json(json);
  }
}

}  // namespace mesher::app
