#pragma once

#include <filesystem>

namespace mesher::app {

/// What ends the shown document: another file is opened, or the program quits.
struct Leaving {
  std::filesystem::path file;  ///< to open; empty: quit
};

}  // namespace mesher::app
