#pragma once

#include <vulkan/vulkan_core.h>

#include <memory>
#include <span>
#include <string>

#include "app/document/session.h"
#include "app/input/keys.h"
#include "engine/core/image.h"

namespace mesher::app {

struct ScriptOptions {
  std::string device;       ///< as gpu::DeviceOptions::select
  bool validation = false;  ///< with the Khronos validation layer
  bool panels = false;      ///< pictures show the panels too, as a window would
};

/// Drives a session without a window: keys in, pictures out. The GPU is set up when the first
/// picture is asked for.
class ScriptedSession {
 public:
  ScriptedSession(Session& session, const ScriptOptions& options);
  ~ScriptedSession();
  ScriptedSession(const ScriptedSession&) = delete;
  ScriptedSession& operator=(const ScriptedSession&) = delete;

  /// Presses keys one after the other, until one quits. A screenshot key writes next_screenshot().
  /// Throws UsageError for a key that does nothing.
  void press(std::span<const KeyPress> keys);
  /// The model as the session shows it, at session.window's size. Throws DeviceError.
  Image picture();
  /// Throws DeviceError with the first validation message, where there is one.
  void expect_no_messages() const;

 private:
  struct Gpu;
  struct PanelLayer;

  Image picture_with_panels();
  VkExtent2D extent() const;

  Session& session_;
  ScriptOptions options_;
  std::unique_ptr<Gpu> gpu_;
  std::unique_ptr<PanelLayer> panel_layer_;
};

}  // namespace mesher::app
