#pragma once

#include <glm/vec2.hpp>
#include <map>

#include "engine/gpu/handles.h"
#include "engine/gpu/instance.h"

struct GLFWwindow;
struct ImGuiContext;

namespace mesher::app {

/// ImGui over a finished picture: in a window, or (without one) over any image, for pictures of the
/// whole program. One at a time. Between `begin` and `end` panels may be drawn.
class Overlay {
 public:
  /// `window` null: no window; time and size are then what `begin` is told. With a window, its own
  /// event callbacks must be set before; ImGui's pass events on to them.
  Overlay(const gpu::Instance& instance, gpu::Device& device, VkFormat format, GLFWwindow* window);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  void begin(const glm::dvec2& size);
  void end();
  /// Records the panels into an image that is in COLOR_ATTACHMENT_OPTIMAL, and leaves it there.
  void draw(VkCommandBuffer commands, VkImageView view, VkExtent2D extent);
  /// The views given to `draw` so far are gone.
  void forget_images() { framebuffers_.clear(); }
  /// A text field has the keyboard.
  bool wants_text() const;
  /// Closes color pickers and the like; false where none is open.
  bool close_popups();

 private:
  using UniqueRenderPass = gpu::Unique<VkRenderPass, vkDestroyRenderPass>;
  using UniqueFramebuffer = gpu::Unique<VkFramebuffer, vkDestroyFramebuffer>;
  using UniqueDescriptorPool = gpu::Unique<VkDescriptorPool, vkDestroyDescriptorPool>;

  void create_render_pass(VkFormat format);
  void create_descriptor_pool();
  void start_backends(const gpu::Instance& instance, GLFWwindow* window);

  gpu::Device& device_;
  ImGuiContext* context_;
  bool has_window_;
  UniqueRenderPass render_pass_;
  UniqueDescriptorPool descriptor_pool_;
  std::map<VkImageView, UniqueFramebuffer> framebuffers_;
};

}  // namespace mesher::app
