#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>

#include "app/cli/lods_command.h"
#include "app/cli/simplify_command.h"

namespace mesher::app {

/// Adds `--faces`: a number of faces, at least 1.
CLI::Option* add_faces(CLI::App& command, std::optional<std::uint32_t>& faces, const char* help);

/// Adds the targets and rules of `simplify`.
void add_simplify_flags(CLI::App& command, SimplifyArguments& arguments);

/// Adds the levels and rules of `lods`.
void add_lods_flags(CLI::App& command, LodArguments& arguments);

}  // namespace mesher::app
