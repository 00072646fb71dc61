#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "app/document/session.h"
#include "app/files/load_job.h"
#include "app/viewer/background_work.h"
#include "app/viewer/graphics.h"
#include "engine/core/error.h"

namespace mesher::app {

/// Keeps the window usable when the GPU fails. If it runs out of memory, the last change is
/// reverted, and the session's error says so. If the device or the surface is lost, the graphics
/// are restarted, and the session's notice says so.
class Recovery {
 public:
  /// `frame_first`: frames the model of the command line; may be empty.
  Recovery(Session& session, Graphics& graphics, BackgroundWork& work,
           std::function<void(Session&)> frame_first)
      : session_(session), graphics_(graphics), work_(work), frame_first_(std::move(frame_first)) {}

  enum class Outcome { unchanged, changed, reverted };
  /// Updates the mirror, and reverts the last change if that fails. Throws DeviceError if there is
  /// nothing left to revert; GraphicsFailed.
  Outcome update();

  /// Shows a loaded model in a tab of its own, or keeps the shown one if the GPU cannot hold the
  /// new one.
  void show(LoadedModel&& loaded);
  /// Call when a step that drew failed; then draw again. Throws GraphicsFailed.
  void restart(const DeviceError& failure);

 private:
  bool revert_settings();
  bool revert_edit();
  bool revert_mode();
  bool revert_tab();

  Session& session_;
  Graphics& graphics_;
  BackgroundWork& work_;
  std::function<void(Session&)> frame_first_;
  std::optional<render::Settings> good_settings_;  ///< of the last update that succeeded
  std::optional<std::uint64_t> good_revision_;
  std::uint64_t good_opening_ = 0;  ///< Document::opening of the model that was shown last
};

}  // namespace mesher::app
