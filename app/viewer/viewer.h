#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/document/session.h"
#include "app/files/load_job.h"
#include "app/files/pm_arrival.h"
#include "app/input/keys.h"
#include "engine/io/read.h"

namespace mesher::app {

struct ViewerOptions {
  std::string device;       ///< as gpu::DeviceOptions::select
  bool validation = false;  ///< with the Khronos validation layer
  float ui_scale = 0.0F;    ///< size of the panels; 0: that of the monitor
  bool is_sized = true;     ///< the window has the session's size; otherwise, the default one
  std::filesystem::path state_log;      ///< see StateLog
  std::filesystem::path turn_log;       ///< see TurnLog
  std::filesystem::path state_folder;   ///< of journals; empty: edits are not kept in a crash
  std::filesystem::path config_folder;  ///< of settings; empty: they are not kept
  /// Frames the model once it is loaded; empty: it is seen from the default angle.
  std::function<void(Session&)> frame_first;
  io::ReadOptions read;  ///< for files opened later
};

/// What is still to be loaded when the window opens; at most one of them.
struct RestOfModel {
  std::unique_ptr<PmArrival> arrival;
  std::unique_ptr<LoadJob> load;
};

/// Shows the session in a window of its size until the person quits. Presses `keys` first. Draws
/// when something has changed, and sleeps otherwise. Errors of files are shown in the window.
/// `rest`: loads the session's model, or the rest of it; it is taken once there is a window.
/// Throws NoDisplay if no window can be opened. Throws DeviceError if there is no usable Vulkan
/// device, or if the validation layer reports a message.
void run_viewer(Session& session, const std::vector<KeyPress>& keys, const ViewerOptions& options,
                RestOfModel& rest);

}  // namespace mesher::app
