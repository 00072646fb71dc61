#include "app/cli/simplify_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/cli/batch.h"
#include "app/cli/progress_line.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"
#include "engine/analysis/distance.h"
#include "engine/analysis/hausdorff.h"
#include "engine/analysis/self_intersections.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/format.h"
#include "engine/io/losses.h"
#include "engine/io/write.h"
#include "engine/simplify/cards.h"
#include "engine/simplify/prune.h"
#include "engine/simplify/shapes.h"
#include "engine/simplify/simplify.h"
#include "engine/simplify/simplify_model.h"

namespace mesher::app {
namespace {

/// Times of simplifying, of carrying attributes over, and of the statistics: the last two take
/// hardly any time for a target of 5 %.
constexpr double kCommandWeights[] = {0.96, 0.02, 0.02};
/// Times of measuring the distance, and of bounding it: 0.83 and 0.17 for 0.1 million faces, 0.24
/// and 0.76 for 1.4 million.
constexpr double kMeasureWeights[] = {0.5, 0.5};

double parse_max_error(const std::string& text, double diagonal) {
  const bool is_percent = text.ends_with('%');
  const char* end = text.data() + text.size() - (is_percent ? 1 : 0);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value) || value <= 0.0) {
    throw UsageError("--max-error: '" + text +
                     "' is not a number above 0 (model units, or percent of the diagonal: 0.5%)");
  }
  return is_percent ? 0.01 * value * diagonal : value;
}

std::string with_percent(const SimplifyOutcome& outcome, double error) {
  return fmt::format("{} ({} of the diagonal)", number_text(error),
                     percent_text(outcome.percent(error)));
}

/// The result of `--measure`.
struct Measured {
  analysis::SurfaceDistance sampled;
  analysis::DistanceInterval certified;
};

void say_distance(const Measured& measured) {
  const auto text = [&](double distance) {
    return fmt::format("{} ({})", number_text(distance),
                       percent_text(measured.sampled.percent(distance)));
  };
  const analysis::OneSidedDistance both = measured.sampled.two_sided();
  say(fmt::format("distance, both directions: rms {}, max {}, certified at most {}", text(both.rms),
                  text(both.max), text(measured.certified.upper)));
}

/// Returns none unless both meshes have faces.
std::optional<Measured> measured(const Mesh& before, const Mesh& after,
                                 const CommonOptions& common) {
  if (before.face_count() == 0 || after.face_count() == 0) return std::nullopt;
  ProgressLine line(!common.quiet);
  Stages stages(line.progress(), kMeasureWeights);
  Measured result;
  stages.next();
  result.sampled = analysis::surface_distance(before, after, {.progress = line.progress()});
  stages.next();
  result.certified =
      analysis::hausdorff_bounds(before, after, {.progress = line.progress()}).two_sided();
  return result;
}

/// Returns none without --measure.
std::optional<std::uint64_t> counted(const Mesh& mesh, const SimplifyArguments& arguments,
                                     const CommonOptions& common) {
  if (!arguments.measure) return std::nullopt;
  ProgressLine line(!common.quiet);
  return analysis::count_self_intersections(mesh, line.progress());
}

}  // namespace

void say_outcome(const SimplifyOutcome& outcome, bool prunes) {
  const simplify::SimplifyReport& r = outcome.report;
  say(fmt::format(
      "{}reached {} of {} in {}: {}{}",
      r.faces_asked > 0 ? fmt::format("asked for {}, ", count_text(r.faces_asked, "face")) : "",
      count_text(r.faces_reached), count_text(r.faces_before), seconds_text(r.seconds.total()),
      describe(r.reason),
      r.faces_reached < r.faces_asked && r.collapses > 0
          ? " (an interior collapse removes two faces)"
          : ""));
  std::string refused;
  for (std::size_t i = 0; i < simplify::kRejections.size(); ++i) {
    const auto cause = static_cast<simplify::Rejection>(i);
    if (r[cause] == 0) continue;
    refused += fmt::format("{}{} by {}", refused.empty() ? "" : ", ", count_text(r[cause]),
                           describe(cause));
  }
  if (!refused.empty()) say("collapses refused: " + refused);
  if (prunes) say(pruned_words(outcome));
  say("estimated error (RMS): " + with_percent(outcome, r.estimated_error));
  if (outcome.is_far()) {
    say("warning: the result is far from the input; ask for more faces to keep its shape");
  }
  if (r.measured_error >= 0.0) {
    say("measured error (max): " + with_percent(outcome, r.measured_error));
  }
  if (r.certified_bound >= 0.0) {
    say("certified bound (max): " + with_percent(outcome, r.certified_bound));
  }
  if (outcome.crosses_seams) say(kCrossesSeams);
  if (outcome.cards.removed > 0) say(cards_words(outcome.cards));
}

Json measures_json(const Mesh& before, const Mesh& after, const SimplifyArguments& arguments,
                   const CommonOptions& common) {
  const auto distance = measured(before, after, common);
  const auto intersections_before = counted(before, arguments, common);
  const auto intersections_after = counted(after, arguments, common);
  if (distance && !common.quiet) say_distance(*distance);
  if (intersections_before && !common.quiet) {
    say(fmt::format("self-intersections (pairs of faces): {} before, {} after",
                    count_text(*intersections_before), count_text(*intersections_after)));
  }
  Json json;
  json["distance"] = distance ? to_json(distance->sampled, distance->certified) : Json();
  json["self_intersections_before"] = intersections_before ? Json(*intersections_before) : Json();
  json["self_intersections_after"] = intersections_after ? Json(*intersections_after) : Json();
  return json;
}

SimplifyOutcome reduce_model(Model& model, const simplify::SimplifyOptions& options, bool prunes,
                             bool keeps_cards) {
  SimplifyOutcome outcome;
  if (!keeps_cards && has_loose_cards(model, options)) {
    const Shape input{std::move(model.mesh), std::move(model.attributes)};
    simplify::ShapesReducer reducer({{input.mesh, input.attributes}},
                                    {.rules = options, .prunes = prunes});
    simplify::ReducedShape reduced =
        std::move(reducer.reduce(options.target_faces, options.progress).front());
    model.mesh = std::move(reduced.shape.mesh);
    model.attributes = std::move(reduced.shape.attributes);
    outcome.report = reduced.report;
    outcome.crosses_seams = reduced.crosses_seams;
    outcome.cards = reduced.cards;
    return outcome;
  }
  auto [simplified, carried, crosses_seams] =
      simplify::simplify_model(std::move(model.mesh), model.attributes, options, prunes);
  model.mesh = std::move(simplified.mesh);
  model.attributes = std::move(carried);
  outcome.report = simplified.report;
  outcome.crosses_seams = crosses_seams;
  return outcome;
}

bool has_loose_cards(const Model& model, const simplify::SimplifyOptions& options) {
  return !std::isfinite(options.max_error) &&
         !simplify::find_cards(model.mesh, model.attributes).sets.empty();
}

std::uint32_t faces_for(double ratio, std::uint32_t faces) {
  return std::max(1U, static_cast<std::uint32_t>(std::llround(ratio * faces)));
}

simplify::SimplifyOptions simplify_options(const SimplifyArguments& arguments, std::uint32_t faces,
                                           double diagonal) {
  if (!arguments.faces && !arguments.ratio && arguments.max_error.empty()) {
    throw UsageError("simplify: give a target: --faces N, --ratio R or --max-error E");
  }
  simplify::SimplifyOptions options = arguments.rules;
  options.certifies = arguments.bound;
  if (arguments.faces) options.target_faces = *arguments.faces;
  if (arguments.ratio) {
    if (!(*arguments.ratio > 0.0 && *arguments.ratio <= 1.0)) {
      throw UsageError("--ratio: " + number_text(*arguments.ratio) +
                       " is not above 0 and at most 1");
    }
    options.target_faces = faces_for(*arguments.ratio, faces);
  }
  if (arguments.prune && !arguments.max_error.empty()) {
    throw UsageError(
        "--prune: cannot be combined with --max-error, because a removed part may be further than "
        "that from the result; give --faces or --ratio instead");
  }
  if (!arguments.max_error.empty())
    options.max_error = parse_max_error(arguments.max_error, diagonal);
  return options;
}

SimplifyOutcome simplify_model(LoadedModel& loaded, simplify::SimplifyOptions options,
                               const CommonOptions& common, bool prunes, bool keeps_cards) {
  Model& model = loaded.model;
  SimplifyOutcome outcome;
  {
    ProgressLine line(!common.quiet);
    Stages stages(line.progress(), kCommandWeights);
    stages.next("simplifying");
    options.progress = line.progress();
    outcome = reduce_model(model, options, prunes, keeps_cards);
    outcome.diagonal = loaded.statistics.box.diagonal();
    stages.next("finishing");
    stages.next();
    loaded.statistics = statistics(model.mesh, line.progress());
  }
  if (!common.quiet) say_outcome(outcome, prunes);
  return outcome;
}

std::string pruned_words(const SimplifyOutcome& outcome) {
  const simplify::SimplifyReport& r = outcome.report;
  if (r.pruned_parts == 0) return "pruned nothing: no part is smaller than the error";
  return fmt::format(
      "pruned {} ({}), the largest {} of the diagonal in size; with them the estimated error would "
      "be {}",
      count_text(r.pruned_parts, "part"), count_text(r.pruned_faces, "face"),
      percent_text(outcome.percent(r.largest_pruned)),
      percent_text(outcome.percent(r.error_unpruned)));
}

std::string cards_words(const simplify::ThinnedCards& cards) {
  return fmt::format("{} of {} removed, the others enlarged by {}", count_text(cards.removed),
                     count_text(cards.cards, "loose card"), number_text(cards.enlarged));
}

void run_simplify(const InputOptions& input, const std::string& output,
                  const SimplifyArguments& arguments, const CommonOptions& common) {
  simplify_options(arguments, 1, 1.0);  // reject bad arguments before the work starts
  check_output(output);
  if (keeps_scene(input, output, common)) return simplify_scene(input, output, arguments, common);
  LoadedModel loaded = load(input, common);
  Mesh& mesh = loaded.model.mesh;
  if (mesh.face_count() == 0) throw InputError(loaded.file.string(), 0, "has no faces to simplify");
  const Mesh before = arguments.measure ? mesh : Mesh();
  const simplify::SimplifyOptions options =
      simplify_options(arguments, mesh.face_count(), loaded.statistics.box.diagonal());
  const SimplifyOutcome outcome =
      simplify_model(loaded, options, common, arguments.prune, arguments.keeps_cards);
  const Json measures = measures_json(before, mesh, arguments, common);
  const std::vector<std::string> losses = write_result(output, loaded.model, common);
  if (!common.json) return;
  Json json{{"input", loaded.file.string()}, {"output", output}};
  json.update(to_json(outcome));
  json.update(measures);
  if (outcome.cards.cards > 0) json["loose_cards"] = to_json(outcome.cards);
  json["lost"] = losses;
  json["repairs"] = to_json(loaded.model.report);
  add_pm(json, loaded.pm);
  print_json(json);
}

}  // namespace mesher::app
