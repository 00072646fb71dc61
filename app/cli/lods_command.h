#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/lod_targets.h"
#include "app/cli/options.h"
#include "app/cli/simplify_command.h"

namespace mesher::app {

inline constexpr const char* kUsualRatios = "1,0.5,0.25";

/// The arguments of `lods`.
struct LodArguments {
  /// None: kUsualRatios, without levels that are far from the model.
  std::optional<std::string> ratios;
  std::string max_errors;      ///< of the levels, instead of ratios
  std::string pixels;          ///< the same on the screen
  std::string coverage;        ///< empty: see default_coverage
  bool is_separate = false;    ///< one file per level, also of a format that holds several
  ScreenArguments screen;      ///< for errors in pixels
  SimplifyArguments simplify;  ///< its targets are ignored
};

/// The file of level i if each has its own: "out_lod0.obj".
std::filesystem::path level_file(const std::filesystem::path& output, std::size_t level);

/// The file that lists separate levels: "out.json".
std::filesystem::path manifest_file(const std::filesystem::path& output);

/// Reads a model and writes it in several levels of detail. Levels by ratio come from one
/// simplification, or from the progressive mesh that was read; each level is simplified separately
/// if parts may be pruned, if the model has loose cards, or if an error chooses it. glTF gets one
/// file, by MSFT_lod; otherwise each level gets a file, and a manifest lists them.
void run_lods(const InputOptions& input, const std::string& output, const LodArguments& arguments,
              const CommonOptions& common);

}  // namespace mesher::app
