#pragma once

#include <filesystem>
#include <string>

#include "app/cli/options.h"

namespace mesher::app {

struct ViewOptions {
  std::string keys;        ///< pressed before the first picture, as parse_keys reads them
  std::string screenshot;  ///< where a scripted session writes its picture; empty: open a window
  bool panels = false;     ///< that picture shows the panels too
  std::string state_log;   ///< see StateLog
};

/// Shows a model in a window. With `screenshot`, presses the keys without a window and writes the
/// picture. Without a display, says so and writes a picture to the current folder.
void run_view(const InputOptions& input, const LookOptions& look, const ViewOptions& view,
              const CommonOptions& common);

}  // namespace mesher::app
