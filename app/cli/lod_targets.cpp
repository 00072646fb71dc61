#include "app/cli/lod_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "app/cli/lods_command.h"
#include "app/cli/options.h"
#include "engine/core/error.h"

namespace mesher::app {
namespace {

bool is_falling(const std::vector<double>& values) {
  return std::ranges::adjacent_find(values, std::less_equal<>()) == values.end();
}

bool is_growing(const std::vector<double>& values) {
  return std::ranges::adjacent_find(values, std::greater_equal<>()) == values.end();
}

double half_fov(const ScreenArguments& screen) {
  return 0.5 * screen.fov_deg * std::numbers::pi / 180.0;
}

}  // namespace

double eye_distance(const ScreenArguments& screen, double diagonal) {
  return screen.distance ? *screen.distance : 0.5 * diagonal / std::sin(half_fov(screen));
}

double pixels_per_unit(const ScreenArguments& screen, double diagonal) {
  const double height = 2.0 * eye_distance(screen, diagonal) * std::tan(half_fov(screen));
  return height > 0.0 ? screen.height_pixels / height : 0.0;
}

Json screen_json(const ScreenArguments& screen, double diagonal) {
  return {{"height", screen.height_pixels},
          {"fov_deg", screen.fov_deg},
          {"distance", eye_distance(screen, diagonal)},
          {"pixels_per_unit", pixels_per_unit(screen, diagonal)}};
}

std::vector<double> parse_ratios(const std::string& text) {
  const std::vector<double> ratios = parse_numbers(text).value_or(std::vector<double>{});
  if (ratios.empty() || !is_falling(ratios) || ratios.front() > 1.0 || ratios.back() <= 0.0) {
    throw UsageError("--ratios: '" + text +
                     "' is not a decreasing list of numbers above 0 and at most 1, such as "
                     "1,0.5,0.25");
  }
  return ratios;
}

std::vector<double> parse_errors(const std::string& option, const std::string& text,
                                 double diagonal) {
  const bool has_percent = text.find('%') != std::string::npos;
  std::string numbers;
  std::ptrdiff_t percents = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    // One at the end of a number; any other one makes the number unreadable.
    const bool is_unit = text[i] == '%' && i > 0 && text[i - 1] != '%' &&
                         (i + 1 == text.size() || text[i + 1] == ',');
    percents += is_unit ? 1 : 0;
    if (!is_unit) numbers += text[i];
  }
  std::vector<double> errors = parse_numbers(numbers).value_or(std::vector<double>{});
  // Zero needs no unit.
  const auto with_unit = std::ranges::count_if(errors, [](double error) { return error != 0.0; });
  const auto zeros = static_cast<std::ptrdiff_t>(errors.size()) - with_unit;
  const auto signs = static_cast<std::ptrdiff_t>(percents);
  const bool has_one_unit = !has_percent || (signs >= with_unit && signs <= with_unit + zeros);
  if (errors.empty() || !has_one_unit || !is_growing(errors) || errors.front() < 0.0) {
    throw UsageError(option + ": '" + text +
                     "' is not an increasing list of numbers above 0 (model units, or all in "
                     "percent of the diagonal), such as 0.1%,0.5%");
  }
  for (double& error : errors)
    error *= has_percent ? 0.01 * diagonal : 1.0;
  return errors;
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

std::vector<LodTarget> lod_targets(const LodArguments& arguments, double diagonal) {
  std::vector<LodTarget> targets;
  if (arguments.max_errors.empty() && arguments.pixels.empty()) {
    for (const double ratio : parse_ratios(arguments.ratios.value_or(kUsualRatios)))
      targets.push_back({.ratio = ratio});
    return targets;
  }
  const bool is_in_pixels = !arguments.pixels.empty();
  const char* option = is_in_pixels ? "--pixels" : "--max-error";
  if (is_in_pixels && arguments.pixels.find('%') != std::string::npos)
    throw UsageError("--pixels: '" + arguments.pixels +
                     "' is not a list of numbers, such as 1,2,4");
  if (arguments.simplify.prune) {
    throw UsageError(std::string("--prune: cannot be combined with ") + option +
                     ", because a removed part may be further than that from the level");
  }
  const double pixels = pixels_per_unit(arguments.screen, diagonal);
  for (double error :
       parse_errors(option, is_in_pixels ? arguments.pixels : arguments.max_errors, diagonal)) {
    if (is_in_pixels) error = pixels > 0.0 ? error / pixels : 0.0;
    targets.push_back({.ratio = std::nullopt, .max_error = error});
  }
  return targets;
}

}  // namespace mesher::app
