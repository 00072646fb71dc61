#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/document/session.h"
#include "app/files/picture.h"
#include "app/input/keys.h"
#include "app/ui/panels.h"
#include "engine/core/image.h"

namespace mesher::app {

struct ScriptOptions {
  std::string device;       ///< as gpu::DeviceOptions::select
  bool validation = false;  ///< with the Khronos validation layer
  bool panels = false;      ///< pictures show the panels too, as a window would
  float ui_scale = 1.0F;    ///< size of the panels
};

/// Drives a session without a window: it presses keys and draws pictures. The GPU is set up for the
/// first picture.
class ScriptedSession {
 public:
  ScriptedSession(Session& session, const ScriptOptions& options);
  ~ScriptedSession();
  ScriptedSession(const ScriptedSession&) = delete;
  ScriptedSession& operator=(const ScriptedSession&) = delete;

  /// Presses keys in order, until one quits. A screenshot key writes next_screenshot(). Throws
  /// UsageError for a key that is not bound to a command.
  void press(std::span<const KeyPress> keys);
  /// Draws the model as the session shows it, at the size of session.view.window. Throws
  /// DeviceError.
  Image picture();
  /// Sets up everything that draws the same picture, for write_picture and write_turntable. Valid
  /// while the session does not change. `pixel_ratio`: of the only picture that is drawn, its
  /// pixels per pixel of the window, so that textures are no finer than it shows; 0: they have all
  /// their pixels. Throws DeviceError.
  PictureScene scene(std::uint32_t pixel_ratio = 0);
  /// Where the widgets of the last picture with panels are; null: there was none.
  const WidgetAreas* widgets() const;
  /// Returns what the pictures so far do not show of the model, a line for each.
  std::vector<std::string> not_drawn() const;
  /// Throws DeviceError with the first validation message, if there is one.
  void expect_no_messages() const;

 private:
  struct Gpu;
  struct PanelLayer;

  void update_mirror(std::uint32_t pixel_ratio = 0);
  Image picture_with_panels();
  VkExtent2D extent() const;

  Session& session_;
  ScriptOptions options_;
  std::unique_ptr<Gpu> gpu_;
  std::unique_ptr<PanelLayer> panel_layer_;
};

}  // namespace mesher::app
