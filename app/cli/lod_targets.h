#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/document/json.h"

namespace mesher::app {

struct LodArguments;

/// How large a model is on the screen, to tell errors in pixels.
struct ScreenArguments {
  double height_pixels = 1080.0;
  double fov_deg = 60.0;           ///< vertical field of view
  std::optional<double> distance;  ///< from the eye to the model's center, in model units
};

/// Returns the distance from the eye to the center of a model with this diagonal: the one that was
/// given, or that at which the model's bounding sphere fills the height of the screen.
double eye_distance(const ScreenArguments& screen, double diagonal);

/// Returns the height in pixels of one model unit at the center of the model. Returns 0 if the
/// model has no size.
double pixels_per_unit(const ScreenArguments& screen, double diagonal);

/// `{"height", "fov_deg", "distance", "pixels_per_unit"}`.
Json screen_json(const ScreenArguments& screen, double diagonal);

/// What decides how far a level is simplified: a share of the faces, or else an error.
struct LodTarget {
  std::optional<double> ratio;
  /// Upper bound on the distance from the model, in its units.
  double max_error = std::numeric_limits<double>::infinity();

  /// Returns whether the level is the model as it is.
  bool is_full() const { return ratio ? *ratio >= 1.0 : max_error == 0.0; }
};

/// Parses the shares of the faces, finest level first. Throws UsageError unless they decrease and
/// are above 0 and at most 1.
std::vector<double> parse_ratios(const std::string& text);

/// Parses errors of levels: all in units of the model, or all in percent of its diagonal. Throws
/// UsageError unless they increase and are above 0; the first may be 0, for the model as it is.
/// `option`: for the message.
std::vector<double> parse_errors(const std::string& option, const std::string& text,
                                 double diagonal);

/// Parses the minimum screen coverage of each level. Throws UsageError unless there are `levels`
/// numbers that decrease and are from 0 to 1.
std::vector<double> parse_coverage(const std::string& text, std::size_t levels);

/// Returns as the minimum coverage of each level the ratio of the next one, and 0 for the last. At
/// that coverage the triangles of the next level are as large on the screen as those of the full
/// model when it covers the whole screen.
std::vector<double> default_coverage(const std::vector<double>& ratios);

/// Returns the levels that the arguments ask for. Throws UsageError for bad values, and if errors
/// are combined with pruning.
std::vector<LodTarget> lod_targets(const LodArguments& arguments, double diagonal);

}  // namespace mesher::app
