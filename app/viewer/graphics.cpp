#include "app/viewer/graphics.h"

#include <utility>

#include "engine/gpu/result.h"

namespace mesher::app {

/// The parts that depend on the device, in the order in which they are made.
struct Graphics::OnDevice {
  OnDevice(const gpu::Instance& instance, const Window& window, const std::string& select)
      : surface(instance, window.create_surface(instance.handle())),
        device(instance, {.select = select, .surface = surface.handle()}),
        presenter(device, surface.handle()),
        painter(device, presenter.format()),
        mirror(device) {}

  gpu::Surface surface;
  gpu::Device device;
  gpu::Presenter presenter;
  ScenePainter painter;
  SceneMirror mirror;
};

Graphics::Graphics(const Window& window, std::string select, bool validation)
    : window_(window),
      select_(std::move(select)),
      instance_({.extensions = Window::instance_extensions(), .validation = validation}),
      on_device_(made()) {}

Graphics::~Graphics() = default;

std::unique_ptr<Graphics::OnDevice> Graphics::made() const {
  return std::make_unique<OnDevice>(instance_, window_, select_);
}

void Graphics::open_overlay(float scale) {
  overlay_ =
      std::make_unique<Overlay>(instance_, device(), presenter().format(), window_.handle(), scale);
}

/// A device that is lost again and again would keep the window busy forever. The presenter waits
/// for a frame before it begins the next but one: then the device has finished the first.
bool Graphics::has_just_restarted() const {
  const std::chrono::duration<double> least(kLeastSeconds);
  return is_restarted_ && (frames_ <= gpu::Presenter::kFramesInFlight ||
                           std::chrono::steady_clock::now() - restarted_ < least);
}

void Graphics::restart(const std::string& reason) {
  if (has_just_restarted()) throw GraphicsFailed(reason + " again, right after a restart");
  try {
    // A window has one surface at a time, and a surface one swapchain.
    if (overlay_) overlay_->detach();
    on_device_.reset();
    on_device_ = made();
    if (overlay_) overlay_->attach(device(), presenter().format());
  } catch (const gpu::LostError&) {
    throw GraphicsFailed(reason + " again, right after a restart");
  } catch (const DeviceError& error) {
    throw GraphicsFailed(reason + ", and the graphics cannot be restarted: " + error.what());
  }
  is_restarted_ = true;
  restarted_ = std::chrono::steady_clock::now();
  frames_ = 0;
}

void Graphics::finish() {
  try {
    device().wait_idle();
  } catch (const gpu::LostError&) {
    // All frames are shown, and nothing else is drawn.
  }
  if (instance_.messages().count() > 0)
    throw DeviceError("validation: " + instance_.messages().list().front());
}

gpu::Device& Graphics::device() {
  return on_device_->device;
}

gpu::Presenter& Graphics::presenter() {
  return on_device_->presenter;
}

ScenePainter& Graphics::painter() {
  return on_device_->painter;
}

SceneMirror& Graphics::mirror() {
  return on_device_->mirror;
}

}  // namespace mesher::app
