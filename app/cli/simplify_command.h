#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/cli/options.h"
#include "app/document/json.h"
#include "app/document/simplification.h"
#include "app/files/load_job.h"

namespace mesher::app {

/// The arguments of `simplify`.
struct SimplifyArguments {
  std::optional<std::uint32_t> faces;
  std::optional<double> ratio;
  std::string max_error;            ///< "0.02" (model units) or "0.5%" (of the diagonal)
  simplify::SimplifyOptions rules;  ///< those of kSimplifyRules
  bool measure = false;
  bool bound = false;        ///< print a certified bound on the distance from the input
  bool prune = false;        ///< remove parts that are smaller than the error
  bool per_mesh = false;     ///< of a scene: the same share of faces for each mesh
  bool keeps_cards = false;  ///< remove no loose cards
};

/// Returns a share of the faces as a number, at least 1.
std::uint32_t faces_for(double ratio, std::uint32_t faces);

/// Returns the options that the arguments mean for a mesh of `faces` faces and this diagonal.
/// Throws UsageError if there is no target, if the ratio is not in (0, 1], if the error is not a
/// number above 0, or if pruning is combined with an error bound.
simplify::SimplifyOptions simplify_options(const SimplifyArguments& arguments, std::uint32_t faces,
                                           double diagonal);

/// Simplifies a model and its attributes in place. If it has loose cards, they share its target.
/// The outcome has no diagonal. Options as those of simplify_model below.
SimplifyOutcome reduce_model(Model& model, const simplify::SimplifyOptions& options, bool prunes,
                             bool keeps_cards);

/// Returns whether a model has loose cards that may be removed, which an error bound forbids.
bool has_loose_cards(const Model& model, const simplify::SimplifyOptions& options);

/// Simplifies a model and its attributes in place, with a line of progress. Reports on stderr
/// unless `common.quiet`. `prunes`: uses `simplify_pruned`. `keeps_cards`: removes no loose cards.
SimplifyOutcome simplify_model(LoadedModel& loaded, simplify::SimplifyOptions options,
                               const CommonOptions& common, bool prunes = false,
                               bool keeps_cards = false);

/// Prints on stderr what a simplification did.
void say_outcome(const SimplifyOutcome& outcome, bool prunes);

/// With `--measure`, measures the distance between two meshes and counts intersections in both, and
/// prints them on stderr. Returns the members of the JSON, which are null without it.
Json measures_json(const Mesh& before, const Mesh& after, const SimplifyArguments& arguments,
                   const CommonOptions& common);

/// "pruned 14 parts (312 faces), the largest 0.25 % of the diagonal in size; ...".
std::string pruned_words(const SimplifyOutcome& outcome);

/// "120 of 680 loose cards removed, the others enlarged by 1.1".
std::string cards_words(const simplify::ThinnedCards& cards);

/// Reads a model, simplifies it, writes it, and reports. If the target cannot be reached, the
/// result is written all the same, and the report says why.
void run_simplify(const InputOptions& input, const std::string& output,
                  const SimplifyArguments& arguments, const CommonOptions& common);

}  // namespace mesher::app
