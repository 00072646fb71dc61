#pragma once

#include <string>
#include <vector>

#include "app/cli/options.h"

namespace mesher::app {

/// Splits "subdivide; simplify_to faces=500" into its edits, without empty ones.
std::vector<std::string> split_script(const std::string& script);

/// Opens a model, runs commands and edits in order, as the window would, and writes what is shown
/// then. A word alone is a command of the table (app/input/commands.h); a word with values is an
/// edit (app/edit/edit_text.h). Throws UsageError before the model is read if there is no such
/// command or edit.
void run_edit(const InputOptions& input, const std::string& output, const std::string& script,
              const CommonOptions& common);

}  // namespace mesher::app
