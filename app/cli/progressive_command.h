#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/cli/options.h"
#include "app/cli/simplify_command.h"
#include "app/document/progressive_view.h"

namespace mesher::app {

/// The arguments of `progressive`.
struct ProgressiveArguments {
  ProgressiveSettings settings;  ///< only base_faces is used
  unsigned coordinate_bits = 0;  ///< 0: lossless
  SimplifyArguments simplify;    ///< its targets are ignored
};

/// The requested level of detail: at most one of the two is given.
struct DetailArguments {
  std::optional<std::uint32_t> faces;
  std::optional<double> lod;  ///< 0: the base, 1: full detail
};

/// Returns the level of a progressive mesh that the arguments ask for. `faces`: the finest level of
/// at most that number of faces, or the base if all levels have more. `lod`: the level with that
/// share of the splits. Pre: one is given, and `lod` is from 0 to 1.
std::uint32_t level_for(const DetailArguments& arguments, const progressive::ProgressiveMesh& mesh);

/// Reads a model, records its simplification to a base, and writes the progressive mesh.
void run_progressive(const InputOptions& input, const std::string& output,
                     const ProgressiveArguments& arguments, const CommonOptions& common);

/// Reads a progressive mesh and writes one of its levels as an ordinary model.
void run_extract(const InputOptions& input, const std::string& output,
                 const DetailArguments& arguments, const CommonOptions& common);

}  // namespace mesher::app
