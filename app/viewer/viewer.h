#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/document/session.h"
#include "app/files/pm_arrival.h"
#include "app/input/keys.h"
#include "engine/io/read.h"

namespace mesher::app {

struct ViewerOptions {
  std::string device;       ///< as gpu::DeviceOptions::select
  bool validation = false;  ///< with the Khronos validation layer
  std::filesystem::path state_log;
  ReadOptions read;  ///< for files opened later
};

/// Shows the session in a window of its size until the person quits. Draws when something changed,
/// and sleeps otherwise. `keys` are pressed first. What goes wrong with a file is shown in the
/// window. `arrival`: by what the session's model still comes, or null; taken once there is a
/// window. Throws NoDisplay where there is nowhere to open a window, DeviceError where there is no
/// usable Vulkan device or the validation layer had something to say.
void run_viewer(Session& session, const std::vector<KeyPress>& keys, const ViewerOptions& options,
                std::unique_ptr<PmArrival>& arrival);

}  // namespace mesher::app
