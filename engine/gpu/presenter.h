#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/gpu/handles.h"

namespace mesher::gpu {

/// The target of one frame in a window.
struct Frame {
  VkCommandBuffer commands = VK_NULL_HANDLE;  ///< recording has begun
  std::uint32_t image_index = 0;
  VkImage image = VK_NULL_HANDLE;     ///< of the swapchain; content and layout initially undefined
  VkImageView view = VK_NULL_HANDLE;  ///< of `image`, in Presenter::format()
  VkExtent2D extent{};
};

/// The swapchain of one window and its frames in flight.
///
/// Images are UNORM: the scene arrives sRGB-encoded (SceneTarget::copy_to). So a window shows the
/// same bytes as a PNG, and ImGui, which blends encoded colors, looks right.
///
///     if (auto frame = presenter.begin(framebuffer_size)) {
///       renderer.draw(frame->commands, target, mesh, camera, settings);
///       target.copy_to(frame->commands, frame->image);   // leaves COLOR_ATTACHMENT_OPTIMAL
///       ...                                              // ImGui's render pass, same layout after
///       presenter.submit(*frame);
///       presenter.present(*frame);
///     }
class Presenter {
 public:
  static constexpr std::uint32_t kFramesInFlight = 2;

  /// Throws DeviceError if the device cannot present to `surface`.
  Presenter(Device& device, VkSurfaceKHR surface);
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  /// Waits for the frame before the last one, acquires an image and begins recording.
  ///
  /// Returns none if there is nothing to draw into (a minimized window: size zero), or if the
  /// swapchain had to be rebuilt twice in a row. Then wait for events and try again. `size` is the
  /// framebuffer size in pixels; the swapchain adopts it. Throws LostError, or OutOfMemoryError.
  std::optional<Frame> begin(VkExtent2D size);
  /// Ends recording and submits. Call it for every frame that has begun. Pre: the image is in
  /// COLOR_ATTACHMENT_OPTIMAL. Throws LostError.
  void submit(const Frame& frame);
  /// Presents a frame that was submitted. A software renderer may finish it first. Returns whether
  /// the frame is shown; if not, because the window has just changed, draw another one. Throws
  /// LostError.
  bool present(const Frame& frame);

  VkFormat format() const { return format_.format; }
  std::uint32_t image_count() const { return static_cast<std::uint32_t>(images_.size()); }
  /// Returns a counter that increases by one whenever images and views are rebuilt: framebuffers
  /// made from the old ones are stale.
  std::uint64_t generation() const { return generation_; }

 private:
  struct SwapchainImage {
    VkImage image = VK_NULL_HANDLE;
    UniqueImageView view;
    // One per image, not per frame: the presentation engine may use it until the image is acquired
    // again.
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
  VkExtent2D requested_{};  ///< window size when the swapchain was created
  UniqueSwapchain swapchain_;
  std::vector<SwapchainImage> images_;
  std::array<FrameSlot, kFramesInFlight> slots_;
  std::uint32_t slot_ = 0;
  bool is_stale_ = true;
  std::uint64_t generation_ = 0;
};

}  // namespace mesher::gpu
