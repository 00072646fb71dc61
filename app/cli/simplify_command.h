#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/edits.h"
#include "app/load_job.h"

namespace mesher::app {

/// What `simplify` was told, in words.
struct SimplifyWords {
  std::optional<std::uint32_t> faces;
  std::optional<double> ratio;
  std::string max_error;  ///< "0.02" in model units, or "0.5%" of the diagonal
  std::string cost = "quadric";
  std::string placement = "optimal";
  std::string boundary = "preserve";
  float crease_angle_deg = 180.0F;
  std::uint64_t seed = 1;
  bool no_intersections = false;
  bool measure = false;
  bool bound = false;  ///< certify how far the result is from the input
  bool prune = false;  ///< leave out parts that are smaller than the error
};

/// The words for --cost and --placement. "qem" is another name of "quadric".
std::vector<std::string> cost_words();
std::vector<std::string> placement_words();

/// What the words mean for a mesh of so many faces and that diagonal. Throws UsageError where they
/// mean nothing: no target, a ratio beyond (0, 1], an error that is not a number above 0, pruning
/// under an error bound.
SimplifyOptions simplify_options(const SimplifyWords& words, std::uint32_t faces, double diagonal);

/// Simplifies a model in place, attributes included, with a line of progress; says on stderr how it
/// went unless `common.quiet`. `prunes`: by `simplify_pruned`.
SimplifyOutcome simplify_model(LoadedModel& loaded, SimplifyOptions options,
                               const CommonOptions& common, bool prunes = false);

/// "pruned 14 parts (312 faces), the largest 0.25 % of the diagonal in size; ...".
std::string pruned_words(const SimplifyOutcome& outcome);

/// Reads a model, simplifies it, writes it, and reports. Falling short of the target is not a
/// failure: the result is written, and the report says why.
void run_simplify(const InputOptions& input, const std::string& output, const SimplifyWords& words,
                  const CommonOptions& common);

}  // namespace mesher::app
