#pragma once

#include <string>
#include <vector>

namespace mesher::app {

/// Converts a command line into the form that the parser knows. The assignment writes long names
/// with one dash (`-input bunny.obj -size 500 -gouraud`): a name in `long_options` (without dashes)
/// gets its second dash. If the first word is not in `commands`, `view` is inserted before it.
std::vector<std::string> normalized_arguments(std::vector<std::string> arguments,
                                              const std::vector<std::string>& commands,
                                              const std::vector<std::string>& long_options);

}  // namespace mesher::app
