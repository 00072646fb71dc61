#pragma once

#include <cstdint>

#include "app/cli/compare_pictures.h"
#include "app/cli/options.h"
#include "engine/analysis/distance.h"

namespace CLI {
class App;
}

namespace mesher::app {

/// The arguments of `compare`, beside the two models.
struct CompareArguments {
  std::uint64_t samples = analysis::DistanceOptions{}.samples;  ///< per surface
  PictureComparison pictures;
};

/// Adds the options of `compare` to its command.
void add_compare_options(CLI::App& command, CompareArguments& arguments);

/// Prints how much the second model differs from the first in shape and look: the distance between
/// the surfaces, in model units and in percent of the first one's diagonal; the deviations of
/// normals, texture coordinates and colors, where both have them; and, if asked for, pictures of
/// both.
void run_compare(const InputOptions& first, const InputOptions& second,
                 const CompareArguments& arguments, const CommonOptions& common);

}  // namespace mesher::app
