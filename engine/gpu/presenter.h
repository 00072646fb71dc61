#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/gpu/handles.h"

namespace mesher::gpu {

/// What one frame in a window is recorded into.
struct Frame {
  VkCommandBuffer commands = VK_NULL_HANDLE;  ///< recording has begun
  std::uint32_t image_index = 0;
  VkImage image = VK_NULL_HANDLE;     ///< of the swapchain; content and layout undefined at first
  VkImageView view = VK_NULL_HANDLE;  ///< of `image`, in Presenter::format()
  VkExtent2D extent{};
};

/// The swapchain of one window and its frames in flight. Images are UNORM: the scene arrives with
/// its sRGB encoding done (SceneTarget::copy_to), so a window shows the very bytes of a PNG, and
/// ImGui, which blends encoded colors, looks as it should.
///
///     if (auto frame = presenter.begin(framebuffer_size)) {
///       renderer.draw(frame->commands, target, mesh, camera, settings);
///       target.copy_to(frame->commands, frame->image);   // leaves COLOR_ATTACHMENT_OPTIMAL
///       ...                                              // ImGui's render pass, same layout after
///       presenter.end(*frame);
///     }
class Presenter {
 public:
  static constexpr std::uint32_t kFramesInFlight = 2;

  /// Throws DeviceError where the device cannot present to `surface`.
  Presenter(Device& device, VkSurfaceKHR surface);
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  /// Waits for the frame before the last, acquires an image and begins recording. None where there
  /// is nothing to draw into (a minimised window: size zero) or the swapchain had just to be made
  /// anew twice in a row: wait for events and try again. `size` is the framebuffer's, in pixels;
  /// the swapchain follows it. Throws DeviceError (a lost device or surface).
  std::optional<Frame> begin(VkExtent2D size);
  /// Ends recording, submits and presents: due for every frame that was begun. Pre: the image is in
  /// COLOR_ATTACHMENT_OPTIMAL.
  void end(const Frame& frame);

  VkFormat format() const { return format_.format; }
  std::uint32_t image_count() const { return static_cast<std::uint32_t>(images_.size()); }
  /// Grows by one whenever images and views are new: framebuffers made of the old ones are stale.
  std::uint64_t generation() const { return generation_; }

 private:
  struct SwapchainImage {
    VkImage image = VK_NULL_HANDLE;
    UniqueImageView view;
    // One an image, not one a frame: the presentation engine may hold it until this image comes
    // round again.
    UniqueSemaphore rendered;
  };
  struct FrameSlot {
    UniqueCommandPool pool;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    UniqueSemaphore acquired;
    Ticket ticket = 0;
  };

  bool recreate(VkExtent2D size);
  void create_images();
  Frame record(std::uint32_t image_index);

  Device& device_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  VkExtent2D extent_{};
  VkExtent2D requested_{};  ///< what the window said when the swapchain was made
  UniqueSwapchain swapchain_;
  std::vector<SwapchainImage> images_;
  std::array<FrameSlot, kFramesInFlight> slots_;
  std::uint32_t slot_ = 0;
  bool is_stale_ = true;
  std::uint64_t generation_ = 0;
};

}  // namespace mesher::gpu
