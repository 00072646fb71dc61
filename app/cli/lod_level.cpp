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

}  // namespace

simplify::SimplifyOptions lod_options(const LodArguments& arguments, std::uint32_t target,
                                      std::uint32_t faces, double diagonal) {
  SimplifyArguments simplify = arguments.simplify;
  simplify.faces = target;
  simplify::SimplifyOptions options = simplify_options(simplify, faces, diagonal);
  if (!arguments.ratios) options.stop_before_error = simplify::kFarFromInput * diagonal;
  return options;
}

std::string level_text(std::size_t index, const LodLevel& level, const std::string& why) {
  std::string text = fmt::format("level {}: {} vertices, {}, for a coverage of at least {}", index,
                                 count_text(static_cast<std::int64_t>(level.vertices)),
                                 count_of(level.faces, "face"), number_text(level.coverage));
  if (level.faces > level.asked_faces) {
    text += "; asked for " + count_of(level.asked_faces, "face");
    if (!why.empty()) text += ": " + why;
  }
  return text;
}

void warn_if_far(std::size_t index, const LodLevel& level, double diagonal) {
  if (level.error < 0.0) return;
  say(fmt::format("warning: level {} is {}", index,
                  far_from("the input", 100.0 * level.error / diagonal)));
}

Json level_json(const LodLevel& level) {
  return {{"ratio", level.ratio},       {"asked_faces", level.asked_faces},
          {"vertices", level.vertices}, {"faces", level.faces},
          {"coverage", level.coverage}, {"far_from_input", level.error >= 0.0}};
}

}  // namespace mesher::app
