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

/// Shows a model in a window. With `screenshot`, runs the keys without a window and writes the
/// picture; without a display, says so and writes one beside the current folder's files.
void run_view(const InputOptions& input, const LookOptions& look, const ViewOptions& view,
              const CommonOptions& common);

}  // namespace mesher::app
