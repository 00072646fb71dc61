#pragma once

#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/load_job.h"

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

/// Draws one picture of a model without a window, simplified to `faces` where that is given.
void run_render(const InputOptions& input, const std::string& output, const LookOptions& look,
                std::optional<std::uint32_t> faces, const CommonOptions& common);

/// One line on stderr.
void say(const std::string& words);

/// Before the work, not after it: throws UsageError where no format has that ending, OutputError
/// where the file plainly cannot be written.
void check_output(const std::string& output);

/// Writes a model and says on stderr how large it is and what the format cannot hold, unless
/// `common.quiet`. Returns what it cannot hold. Throws OutputError.
std::vector<std::string> write_result(const std::string& output, const Model& model,
                                      const CommonOptions& common);

/// Reads a model as the options say, creases tagged, with progress on a terminal, and says on
/// stderr what was repaired unless `common.quiet`. Throws InputError.
LoadedModel load(const InputOptions& input, const CommonOptions& common);

}  // namespace mesher::app
