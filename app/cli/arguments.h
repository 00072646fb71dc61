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

/// Returns the name that was probably meant: the one that turns into `word` by the fewest inserted,
/// removed, replaced or swapped letters, at most two and fewer than half of its letters. Empty:
/// none is so near. O(names times their length squared).
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

/// Returns what was probably meant by options that do not exist: "-gourad: did you mean -gouraud?",
/// one line each, with as many dashes as were typed. Names as for `normalized_arguments`.
std::vector<std::string> suggestions(const std::vector<std::string>& arguments,
                                     const std::vector<std::string>& long_options);

}  // namespace mesher::app
