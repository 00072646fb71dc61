#pragma once

#include <string>

namespace mesher::app {

/// Returns what `--version` prints: version and commit, and the Vulkan device that would be used.
/// Asks the Vulkan loader, which takes some milliseconds.
std::string version_text();

}  // namespace mesher::app
