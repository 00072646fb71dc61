#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/cli/simplify_command.h"

namespace mesher::app {

inline constexpr const char* kUsualRatios = "1,0.5,0.25";

/// What `lods` was told, in arguments.
struct LodArguments {
  /// None: kUsualRatios, but no level that is far from the model.
  std::optional<std::string> ratios;
  std::string coverage;        ///< empty: see default_coverage
  SimplifyArguments simplify;  ///< of which targets are not taken
};

/// Shares of the faces, of the finest level first. Throws UsageError unless they fall, from 1 at
/// most to above 0.
std::vector<double> parse_ratios(const std::string& text);

/// The share of the screen's area down to which each level is meant. Throws UsageError unless there
/// are `levels`, falling, from 1 at most to 0 at least.
std::vector<double> parse_coverage(const std::string& text, std::size_t levels);

/// Each level down to where the next one has triangles of the same size on the screen as the full
/// model has when it covers all of it: down to the next one's ratio. The last one down to 0.
std::vector<double> default_coverage(const std::vector<double>& ratios);

/// Where level i goes in a format that holds one: "out_lod0.obj".
std::filesystem::path level_file(const std::filesystem::path& output, std::size_t level);

/// Reads a model and writes it in several levels of detail, all from one simplification (or from
/// the progressive mesh that was read; where parts may be pruned, from one of its own for each
/// level): glTF in one file, by MSFT_lod; other formats in one each.
void run_lods(const InputOptions& input, const std::string& output, const LodArguments& arguments,
              const CommonOptions& common);

}  // namespace mesher::app
