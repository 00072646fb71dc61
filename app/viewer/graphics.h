#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "app/ui/overlay.h"
#include "app/viewer/scene_mirror.h"
#include "app/viewer/scene_painter.h"
#include "app/viewer/window.h"
#include "engine/core/error.h"
#include "engine/gpu/presenter.h"

namespace mesher::app {

/// The graphics of a window failed again right after a restart, or cannot be restarted.
class GraphicsFailed : public DeviceError {
 public:
  using DeviceError::DeviceError;
};

/// Everything of a window that is on the GPU. It has one owner, because all of it ends together
/// when the device or the surface is lost, and all of it is made again from what the CPU has: the
/// document, the view and the state of the panels.
class Graphics {
 public:
  /// Throws DeviceError. `select`: as gpu::DeviceOptions::select. `validation`: with the Khronos
  /// validation layer.
  Graphics(const Window& window, std::string select, bool validation);
  ~Graphics();
  Graphics(const Graphics&) = delete;
  Graphics& operator=(const Graphics&) = delete;

  /// Starts to draw panels. `scale` as for Overlay. Call after Window::set_events.
  void open_overlay(float scale);

  /// Makes everything again after a failure; the mirror is then empty. `reason`: of the failure.
  /// Throws GraphicsFailed if it fails, or if the last restart did not help: the device has not
  /// finished a frame since, or was restarted kLeastSeconds ago. Then there is nothing to draw
  /// with.
  void restart(const std::string& reason);
  static constexpr double kLeastSeconds = 5.0;
  /// Call for each frame that was presented.
  void note_frame() { ++frames_; }
  /// Waits for the device. Throws DeviceError with the first validation message, if there is one.
  void finish();

  gpu::Device& device();
  gpu::Presenter& presenter();
  ScenePainter& painter();
  SceneMirror& mirror();
  /// Pre: open_overlay was called.
  Overlay& overlay() { return *overlay_; }

 private:
  struct OnDevice;
  bool has_just_restarted() const;
  std::unique_ptr<OnDevice> made() const;

  const Window& window_;
  std::string select_;
  gpu::Instance instance_;
  std::unique_ptr<OnDevice> on_device_;
  std::unique_ptr<Overlay> overlay_;
  bool is_restarted_ = false;
  std::chrono::steady_clock::time_point restarted_;
  unsigned frames_ = 0;  ///< presented since the last restart
};

}  // namespace mesher::app
