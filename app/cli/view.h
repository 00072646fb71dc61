#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/document/session.h"

namespace mesher::app {

struct ViewOptions {
  std::string keys;        ///< pressed before the first picture, as parse_keys reads them
  std::string screenshot;  ///< where a scripted session writes its picture; empty: open a window
  bool panels = false;     ///< that picture shows the panels too
  float ui_scale = 0.0F;   ///< size of the panels; 0: that of the monitor
  std::string state_log;   ///< see StateLog
  std::string turn_log;    ///< see TurnLog
  bool is_sample = false;  ///< no model was named: the start screen is shown over one
  std::vector<std::string> more;  ///< models that are opened as tabs beside the first
  std::string nearest_command;    ///< that a model which does not exist may be a misspelling of
};

/// Opens a model, or a progressive mesh in full detail and in progressive mode. Throws as `load`.
void open_whole(Session& session, const InputOptions& input, const CommonOptions& common);

/// Shows a model in a window. With `screenshot`, presses the keys without a window and writes the
/// picture. Without a display, says so and writes a picture to the current folder.
void run_view(const InputOptions& input, const LookOptions& look, const ViewOptions& view,
              const CommonOptions& common);

}  // namespace mesher::app
