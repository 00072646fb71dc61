#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/document/json.h"
#include "app/files/load_job.h"

namespace mesher::app {

/// Prints counts, topology, measures and repairs of a model.
void run_info(const InputOptions& input, const CommonOptions& common);

/// Reads one format and writes another; reports what was repaired. glTF is copied to glTF as it is,
/// with all that it holds, unless `repairs` asks for meshes that are built as for an edit.
void run_convert(const InputOptions& input, const std::string& output, bool ascii, bool repairs,
                 const CommonOptions& common);

/// Prints one line on stderr, "mesher: " and the words. All messages are printed by it, since the
/// words may hold names from files: control characters are escaped.
void say(const std::string& words);
/// Prints on stderr what was repaired, if anything was.
void say_repairs(const BuildReport& report);
/// As above; also prints the warnings of the reader.
void say_findings(const Model& model);
/// Says what `output` does not hold of the model's file.
void say_losses(const std::string& output, const std::vector<std::string>& losses);
/// Prints the size of what was written.
void say_written(const std::string& output, std::uint32_t vertices, std::uint32_t faces);

/// Prints `json` on stdout.
void print_json(const Json& json);
/// Adds the summary of a progressive mesh, if one was read, under `key`.
void add_pm(Json& json, const std::optional<io::PmSummary>& pm, const char* key = "pm");
/// Throws UsageError if no writable format has the file's ending.
void check_format(const std::string& output);
/// As above; also throws OutputError if the file cannot be written. Call before the work starts.
void check_output(const std::string& output);

/// Writes a model. Returns what the format cannot hold. Unless `common.quiet`, also prints that on
/// stderr, and the size of the model. Throws OutputError.
std::vector<std::string> write_result(const std::string& output, const Model& model,
                                      const CommonOptions& common);

/// Reads a model as the options say, and tags creases. Shows progress on a terminal. Prints on
/// stderr what was repaired, unless `common.quiet`, and always what is damaged. Throws InputError.
LoadedModel load(const InputOptions& input, const CommonOptions& common);

/// A model, and all its levels if its file holds a progressive mesh.
struct LoadedLevels {
  LoadedModel loaded;  ///< in full detail
  std::optional<progressive::ProgressiveMesh> levels;
  progressive::ProgressiveAttributes attributes;  ///< of the levels; may be empty
};
/// As `load`, for commands that use the levels. Also throws UsageError if creases are to be tagged
/// on a progressive mesh.
LoadedLevels load_levels(const InputOptions& input, const CommonOptions& common);

}  // namespace mesher::app
