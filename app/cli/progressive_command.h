#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/cli/options.h"
#include "app/cli/simplify_command.h"

namespace mesher::app {

/// What `progressive` was told, in arguments.
struct ProgressiveArguments {
  ProgressiveSettings settings;  ///< of which base_faces
  unsigned coordinate_bits = 0;  ///< 0: lossless
  SimplifyArguments simplify;    ///< of which targets are not taken
};

/// How much detail was asked for: one of the two.
struct DetailArguments {
  std::optional<std::uint32_t> faces;
  std::optional<double> lod;  ///< 0: the base, 1: everything
};

/// The level of a progressive mesh that the arguments mean: at most so many faces, or the base; or
/// that share of the splits. Pre: one is given, the share is 0 to 1.
std::uint32_t level_for(const DetailArguments& arguments, const ProgressiveMesh& mesh);

/// Reads a model, records its simplification to a base, and writes the progressive mesh of it.
void run_progressive(const InputOptions& input, const std::string& output,
                     const ProgressiveArguments& arguments, const CommonOptions& common);

/// Reads a progressive mesh and writes one of its levels as an ordinary model.
void run_extract(const InputOptions& input, const std::string& output,
                 const DetailArguments& arguments, const CommonOptions& common);

}  // namespace mesher::app
