#include "app/cli/lod_level.h"

#include <fmt/format.h>

#include "app/cli/batch.h"
#include "app/document/words.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

std::string count_of(std::uint64_t count, const char* what) {
  return count_text(static_cast<std::int64_t>(count), what);
}

std::string error_text(const LodReport& report, const LodLevel& level) {
  if (level.error() == 0.0) return "error 0";
  return fmt::format("error {} ({}), {} pixels", number_text(level.error()),
                     level.bound >= 0.0 ? "certified bound" : "RMS",
                     number_text(report.pixels(level.error())));
}

}  // namespace

bool LodReport::is_far(const LodLevel& level) const {
  return level.rms > simplify::kFarFromInput * diagonal;
}

simplify::SimplifyOptions lod_options(const LodArguments& arguments, std::uint32_t target,
                                      std::uint32_t faces, double diagonal) {
  SimplifyArguments simplify = arguments.simplify;
  simplify.faces = target;
  simplify::SimplifyOptions options = simplify_options(simplify, faces, diagonal);
  if (!arguments.ratios) options.stop_before_error = simplify::kFarFromInput * diagonal;
  return options;
}

simplify::SimplifyOptions lod_options_within(const LodArguments& arguments, double max_error) {
  SimplifyArguments simplify = arguments.simplify;
  simplify.ratio = 1.0;
  simplify::SimplifyOptions options = simplify_options(simplify, 1, 1.0);
  options.target_faces = 0;
  options.max_error = max_error;
  return options;
}

void set_coverage(std::vector<LodLevel>& levels, const LodArguments& arguments,
                  std::uint64_t faces) {
  std::vector<double> ratios;
  for (LodLevel& level : levels) {
    if (level.asked_faces == 0) level.ratio = double(level.faces) / double(faces);
    ratios.push_back(level.ratio);
  }
  const std::vector<double> coverage = arguments.coverage.empty()
                                           ? default_coverage(ratios)
                                           : parse_coverage(arguments.coverage, levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i)
    levels[i].coverage = coverage[i];
}

std::string level_text(const LodReport& report, std::size_t index, const std::string& why) {
  const LodLevel& level = report.levels[index];
  std::string text = fmt::format("level {}: {} vertices, {}, for a coverage of at least {}, {}",
                                 index, count_text(static_cast<std::int64_t>(level.vertices)),
                                 count_of(level.faces, "face"), number_text(level.coverage),
                                 error_text(report, level));
  if (level.asked_faces > 0 && level.faces > level.asked_faces) {
    text += "; asked for " + count_of(level.asked_faces, "face");
    if (!why.empty()) text += ": " + why;
  }
  return text;
}

void say_rest_of_level(const LodReport& report, std::size_t index) {
  const LodLevel& level = report.levels[index];
  if (level.cards.removed > 0) say(fmt::format("level {}: {}", index, cards_words(level.cards)));
  if (!report.is_far(level)) return;
  say(fmt::format("warning: level {} is {}", index,
                  far_from("the input", 100.0 * level.rms / report.diagonal)));
}

Json level_json(const LodReport& report, std::size_t index) {
  const LodLevel& level = report.levels[index];
  const bool is_bound = level.bound >= 0.0;
  return {{"ratio", level.ratio},
          {"asked_faces", level.asked_faces > 0 ? Json(level.asked_faces) : Json()},
          {"vertices", level.vertices},
          {"faces", level.faces},
          {"coverage", level.coverage},
          {"far_from_input", report.is_far(level)},
          {"error_rms", level.rms},
          {"error_bound", is_bound ? Json(level.bound) : Json()},
          {"error_pixels", report.pixels(level.error())},
          {"loose_cards", to_json(level.cards)}};
}

void write_manifest(io::AtomicFile& file, const LodReport& report,
                    std::span<const std::filesystem::path> files,
                    const std::filesystem::path& input) {
  Json json{{"input", input.filename().string()},
            {"screen", screen_json(report.screen, report.diagonal)},
            {"levels", Json::array()}};
  for (std::size_t i = 0; i < files.size(); ++i) {
    const LodLevel& level = report.levels[i];
    json["levels"].push_back({{"level", i},
                              {"file", files[i].filename().string()},
                              {"vertices", level.vertices},
                              {"faces", level.faces},
                              {"error", level.error()},
                              {"error_is", level.bound >= 0.0 ? "certified bound" : "RMS"},
                              {"pixels", report.pixels(level.error())},
                              {"coverage", level.coverage}});
  }
  file.write(to_text(json) + "\n");
}

}  // namespace mesher::app
