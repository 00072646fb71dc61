#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/document/json.h"
#include "app/files/load_job.h"

namespace mesher::app {

/// Counts, topology, measures and repairs of a model.
void run_info(const InputOptions& input, const CommonOptions& common);

/// Reads one format and writes another; says what was repaired on the way.
void run_convert(const InputOptions& input, const std::string& output, bool ascii,
                 const CommonOptions& common);

/// How far two surfaces lie apart, both ways, in model units and percent of the first one's
/// diagonal.
void run_compare(const InputOptions& first, const InputOptions& second, std::uint64_t samples,
                 const CommonOptions& common);

/// One line on stderr.
void say(const std::string& words);

/// `json` on stdout.
void print_json(const Json& json);
/// Adds what there is to say of a progressive mesh that was read, under `key`.
void add_pm(Json& json, const std::optional<PmSummary>& pm, const char* key = "pm");
/// Throws UsageError where no format that holds a mesh has that ending.
void check_format(const std::string& output);
/// The same, and OutputError where the file plainly cannot be written: before the work, not after.
void check_output(const std::string& output);

/// Writes a model and says on stderr how large it is and what the format cannot hold, unless
/// `common.quiet`. Returns what it cannot hold. Throws OutputError.
std::vector<std::string> write_result(const std::string& output, const Model& model,
                                      const CommonOptions& common);

/// Reads a model as the options say, creases tagged, with progress on a terminal, and says on
/// stderr what was repaired unless `common.quiet`, and in any case what is damaged. Throws
/// InputError.
LoadedModel load(const InputOptions& input, const CommonOptions& common);

/// A model, and all its levels where its file holds them.
struct LoadedLevels {
  LoadedModel loaded;  ///< in full detail
  std::optional<ProgressiveMesh> levels;
};
/// The same for commands that make use of levels. Throws UsageError too, where a progressive mesh
/// is to get creases.
LoadedLevels load_levels(const InputOptions& input, const CommonOptions& common);

}  // namespace mesher::app
