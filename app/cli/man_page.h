#pragma once

#include <string>

#include "app/cli/command_table.h"

namespace mesher::app {

/// Returns the man page of the program, mesher(1), which lists the commands.
std::string man_page(const CommandTable& table, const std::string& version);

/// Returns the man page of a command, such as mesher-simplify(1).
std::string man_page(const CommandTable& table, const CommandInfo& command,
                     const std::string& version);

}  // namespace mesher::app
