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

/// The arguments of `lods`.
struct LodArguments {
  /// None: kUsualRatios, without levels that are far from the model.
  std::optional<std::string> ratios;
  std::string coverage;        ///< empty: see default_coverage
  SimplifyArguments simplify;  ///< its targets are ignored
};

/// Parses the shares of the faces, finest level first. Throws UsageError unless they decrease and
/// are above 0 and at most 1.
std::vector<double> parse_ratios(const std::string& text);

/// Parses the minimum screen coverage of each level. Throws UsageError unless there are `levels`
/// numbers that decrease and are from 0 to 1.
std::vector<double> parse_coverage(const std::string& text, std::size_t levels);

/// Returns as the minimum coverage of each level the ratio of the next one, and 0 for the last. At
/// that coverage the triangles of the next level are as large on the screen as those of the full
/// model when it covers the whole screen.
std::vector<double> default_coverage(const std::vector<double>& ratios);

/// The file of level i in a format that holds one level per file: "out_lod0.obj".
std::filesystem::path level_file(const std::filesystem::path& output, std::size_t level);

/// Reads a model and writes it in several levels of detail. All levels come from one
/// simplification, or from the progressive mesh that was read; if parts may be pruned, each level
/// is simplified separately. glTF gets one file, by MSFT_lod; other formats get one file per level.
void run_lods(const InputOptions& input, const std::string& output, const LodArguments& arguments,
              const CommonOptions& common);

}  // namespace mesher::app
