#pragma once

#include <string>
#include <vector>

namespace mesher::app {

/// Brings a command line into the one form that the parser knows. The assignment's spellings (one
/// dash, long name: `-input bunny.obj -size 500 -gouraud`) get their second dash where
/// `long_options` (without dashes) has the name; without a command word, `view` is meant.
std::vector<std::string> normalized_arguments(std::vector<std::string> arguments,
                                              const std::vector<std::string>& commands,
                                              const std::vector<std::string>& long_options);

}  // namespace mesher::app
