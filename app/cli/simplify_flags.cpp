#include "app/cli/simplify_flags.h"

#include <limits>

#include "app/cli/option_parsing.h"

namespace mesher::app {
namespace {

void add_prune(CLI::App& command, SimplifyArguments& arguments) {
  command.add_flag("--prune", arguments.prune,
                   "remove parts that are smaller than the error, so that the others keep their "
                   "shape");
}

void add_sharing(CLI::App& command, SimplifyArguments& arguments) {
  command.add_flag("--per-mesh", arguments.per_mesh,
                   "glTF scenes: keep the same share of the faces of each mesh (default: one "
                   "budget for all, by error in the scene)");
  command.add_flag("--keep-cards", arguments.keeps_cards,
                   "remove no loose cards such as leaves (default: where that costs least, remove "
                   "some at random and enlarge the others)");
}

void add_level_choice(CLI::App& command, LodArguments& arguments) {
  CLI::Option* ratios = command.add_option(
      "--ratios", arguments.ratios,
      "share of the faces that each level keeps, decreasing (default: 1,0.5,0.25, "
      "but no level further than 5 % of the diagonal from the model)");
  CLI::Option* errors = command.add_option(
      "--max-error", arguments.max_errors,
      "instead of ratios: upper bound on the distance of each level from the model, increasing, in "
      "model units or in percent of the diagonal (0,0.1%,0.5%; 0: the model itself); each level "
      "has the fewest faces within");
  errors->excludes(ratios);
  command
      .add_option("--pixels", arguments.pixels,
                  "the same in pixels on the screen that the next three options describe (0,1,2)")
      ->excludes(ratios)
      ->excludes(errors);
  ScreenArguments& screen = arguments.screen;
  command
      .add_option("--screen-height", screen.height_pixels,
                  "height of the screen [pixels] (default: 1080)")
      ->check(number_between(1.0, 1e6));
  command.add_option("--fov", screen.fov_deg, "vertical field of view [deg] (default: 60)")
      ->check(number_between(1.0, 170.0));
  command
      .add_option("--distance", screen.distance,
                  "distance from the eye to the center of the model [model units] (default: where "
                  "its bounding sphere fills the height of the screen)")
      ->check(number_between(1e-30, 1e30));
}

}  // namespace

CLI::Option* add_faces(CLI::App& command, std::optional<std::uint32_t>& faces, const char* help) {
  return command.add_option("--faces", faces, help)
      ->check(CLI::Range(1U, std::numeric_limits<std::uint32_t>::max()));
}

void add_simplify_flags(CLI::App& command, SimplifyArguments& arguments) {
  CLI::Option* faces = add_faces(command, arguments.faces, "number of faces to keep");
  command
      .add_option("--ratio", arguments.ratio, "share of the faces to keep, above 0 and at most 1")
      ->excludes(faces);
  command.add_option(
      "--max-error", arguments.max_error,
      "upper bound on the distance between input and result, in model units or in percent of the "
      "diagonal (0.5%); with --faces or --ratio, stop at the first limit reached");
  add_options(command, simplify::kSimplifyRules, arguments.rules);
  add_prune(command, arguments);
  add_sharing(command, arguments);
}

void add_lods_flags(CLI::App& command, LodArguments& arguments) {
  add_level_choice(command, arguments);
  command.add_option("--coverage", arguments.coverage,
                     "minimum screen coverage of each level, decreasing (default: the next level's "
                     "ratio; 0 for the last)");
  command.add_flag("--bound", arguments.simplify.bound,
                   "report a certified bound on the error of each level, instead of the RMS error");
  command.add_flag("--separate", arguments.is_separate,
                   "glTF: one file per level (OUT_lod0.glb, ...) instead of MSFT_lod");
  add_options(command, simplify::kSimplifyRules, arguments.simplify.rules);
  add_prune(command, arguments.simplify);
  add_sharing(command, arguments.simplify);
}

}  // namespace mesher::app
