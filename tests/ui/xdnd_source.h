#pragma once

#include <string>
#include <vector>

namespace mesher::test {

/// Drops a file on a window as a file manager does, by the XDND protocol, version 5
/// (freedesktop.org/wiki/Specifications/XDND). Returns whether the window accepted it.
bool drop_file(const std::string& display_name, unsigned long target, const std::string& path);
/// As above, several files at once.
bool drop_files(const std::string& display_name, unsigned long target,
                const std::vector<std::string>& paths);

}  // namespace mesher::test
