#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <string_view>

#include "app/ui/fonts.h"
#include "engine/gpu/handles.h"
#include "engine/gpu/instance.h"

struct GLFWwindow;
struct ImGuiContext;

namespace mesher::app {

/// Draws ImGui over a finished picture: in a window or, without one, over any image, for pictures
/// of the whole program. There can be one at a time. Draw panels between `begin` and `end`.
class Overlay {
 public:
  /// `window` null: there is no window; `begin` then sets the size, and time advances by a constant
  /// step. With a window, set its event callbacks first: those of ImGui pass events on to them.
  /// `scale`: ImGui's units per point.
  Overlay(const gpu::Instance& instance, gpu::Device& device, VkFormat format, GLFWwindow* window,
          float scale);
  ~Overlay();
  /// Gives back everything that is on the device, but keeps the state of the panels. Call before
  /// the device is destroyed; draw again after `attach`. Works with a lost device.
  void detach();
  /// Continues on another device. Pre: detached.
  void attach(gpu::Device& device, VkFormat format);
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Asks for the glyphs of the code points that the last frame showed. Returns whether there are
  /// more of them in the next frame, so that one is needed.
  bool require_glyphs(const CodePoints& shown) { return fonts_.require(shown); }

  /// Changes the size of the panels from the next frame on. `scale`: ImGui's units per point. Call
  /// between frames.
  void set_scale(float scale);

  /// Begins a frame. If glyphs or another scale were asked for, this waits for the device and
  /// builds the font again.
  void begin(const glm::dvec2& size);
  void end();
  /// Records the panels into an image. The image is in COLOR_ATTACHMENT_OPTIMAL before and after.
  void draw(VkCommandBuffer commands, VkImageView view, VkExtent2D extent);
  /// Call when the views that were given to `draw` no longer exist.
  void forget_images() { framebuffers_.clear(); }
  /// Returns whether a text field has the keyboard focus.
  bool wants_text() const;
  /// Takes the keyboard from the window or text field that has it. Call when a dialog is closed.
  void release_keyboard();
  /// Returns whether a key moves the keyboard focus in panels, or presses the focused widget, so
  /// that it is not the key of a command. `name` as in KeyPress.
  bool takes_key(std::string_view name) const;
  /// Presses the widget that has the keyboard focus, in the next frame. Pre: takes_key("enter").
  void press_focused() { presses_focused_ = true; }
  /// Call when a key ran a command. ImGui sees the key as well: an arrow would focus a widget, and
  /// show its tooltip.
  void ignore_key(std::string_view name);
  /// Puts a text into the clipboard.
  void copy(const std::string& text) const;
  /// Closes popups such as color pickers. Returns whether one was open.
  bool close_popups();

 private:
  using UniqueRenderPass = gpu::Unique<VkRenderPass, vkDestroyRenderPass>;
  using UniqueFramebuffer = gpu::Unique<VkFramebuffer, vkDestroyFramebuffer>;
  using UniqueDescriptorPool = gpu::Unique<VkDescriptorPool, vkDestroyDescriptorPool>;

  void create_render_pass(VkFormat format);
  void create_descriptor_pool();
  void start_renderer();
  void restart_renderer();
  void press_if_asked();

  const gpu::Instance& instance_;
  gpu::Device* device_;  ///< null: detached
  ImGuiContext* context_;
  Fonts fonts_;
  bool has_window_;
  bool presses_focused_ = false;
  int ignored_frames_ = 0;  ///< frames whose keys move no focus
  UniqueRenderPass render_pass_;
  UniqueDescriptorPool descriptor_pool_;
  std::map<VkImageView, UniqueFramebuffer> framebuffers_;
};

}  // namespace mesher::app
