#pragma once

#include <string>

#include "app/cli/command_table.h"

namespace mesher::app {

/// Return what a shell needs to complete commands, options, their values, and files that mesher can
/// open.
std::string bash_completion(const CommandTable& table);
std::string zsh_completion(const CommandTable& table);
std::string fish_completion(const CommandTable& table);

}  // namespace mesher::app
