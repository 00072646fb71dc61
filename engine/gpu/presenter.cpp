#include "engine/gpu/presenter.h"

#include <algorithm>
#include <limits>

#include "engine/core/error.h"
#include "engine/gpu/device_image.h"
#include "engine/gpu/result.h"

namespace mesher::gpu {
namespace {

UniqueSemaphore create_semaphore(Device& device) {
  const VkSemaphoreCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = nullptr, .flags = 0};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(device.handle(), &info, nullptr, &semaphore), "vkCreateSemaphore");
  return {device, semaphore};
}

UniqueCommandPool create_pool(Device& device) {
  const VkCommandPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .pNext = nullptr,
                                     .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                     .queueFamilyIndex = device.queue_family()};
  VkCommandPool pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(device.handle(), &info, nullptr, &pool), "vkCreateCommandPool");
  return {device, pool};
}

VkSurfaceFormatKHR choose_format(const Device& device, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface, &count, nullptr),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface, &count, formats.data()),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  const auto found =
      std::find_if(formats.begin(), formats.end(), [](const VkSurfaceFormatKHR& format) {
        return (format.format == VK_FORMAT_B8G8R8A8_UNORM ||
                format.format == VK_FORMAT_R8G8B8A8_UNORM) &&
               format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
      });
  if (found == formats.end()) throw DeviceError("the window does not support 8-bit RGBA images");
  return *found;
}

VkCompositeAlphaFlagBitsKHR choose_alpha(VkCompositeAlphaFlagsKHR supported) {
  return (supported & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0 ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
}

VkExtent2D choose_extent(const VkSurfaceCapabilitiesKHR& surface, VkExtent2D size) {
  constexpr std::uint32_t kFollowsSwapchain = 0xFFFFFFFFU;
  if (surface.currentExtent.width != kFollowsSwapchain) return surface.currentExtent;
  return {std::clamp(size.width, surface.minImageExtent.width, surface.maxImageExtent.width),
          std::clamp(size.height, surface.minImageExtent.height, surface.maxImageExtent.height)};
}

bool is_empty(VkExtent2D extent) {
  return extent.width == 0 || extent.height == 0;
}

bool differ(VkExtent2D a, VkExtent2D b) {
  return a.width != b.width || a.height != b.height;
}

VkSwapchainCreateInfoKHR swapchain_info(VkSurfaceKHR surface, VkSurfaceFormatKHR format,
                                        const VkSurfaceCapabilitiesKHR& caps, VkExtent2D extent,
                                        VkSwapchainKHR old) {
  const std::uint32_t most =
      caps.maxImageCount == 0 ? std::numeric_limits<std::uint32_t>::max() : caps.maxImageCount;
  VkSwapchainCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
  info.surface = surface;
  info.minImageCount = std::min(caps.minImageCount + 1, most);
  info.imageFormat = format.format;
  info.imageColorSpace = format.colorSpace;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = caps.currentTransform;
  info.compositeAlpha = choose_alpha(caps.supportedCompositeAlpha);
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;  // supported by every device
  info.clipped = VK_TRUE;
  info.oldSwapchain = old;
  return info;
}

}  // namespace

Presenter::Presenter(Device& device, VkSurfaceKHR surface) : device_(device), surface_(surface) {
  VkBool32 presents = VK_FALSE;
  check(vkGetPhysicalDeviceSurfaceSupportKHR(device.physical(), device.queue_family(), surface,
                                             &presents),
        "vkGetPhysicalDeviceSurfaceSupportKHR");
  if (presents == VK_FALSE) throw DeviceError(device.name() + " cannot present to this window");
  format_ = choose_format(device, surface);
  for (FrameSlot& slot : slots_) {
    slot.pool = create_pool(device);
    slot.acquired = create_semaphore(device);
    const VkCommandBufferAllocateInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .pNext = nullptr,
                                           .commandPool = slot.pool.get(),
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
    check(vkAllocateCommandBuffers(device.handle(), &info, &slot.commands),
          "vkAllocateCommandBuffers");
  }
}

Presenter::~Presenter() {
  // The surface may be destroyed right after this, so the swapchain cannot be retired later.
  vkQueueWaitIdle(device_.queue());
  images_.clear();
  swapchain_.reset();
  try {
    device_.wait_idle();
  } catch (const DeviceError&) {
    // The device is lost. Its destructor cleans up the rest.
  }
}

bool Presenter::recreate(VkExtent2D size) {
  VkSurfaceCapabilitiesKHR caps{};
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &caps),
        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  const VkExtent2D extent = choose_extent(caps, size);
  if (is_empty(extent)) return false;
  // Presentation has no fence: the old semaphores are free only when the queue is idle.
  check(vkQueueWaitIdle(device_.queue()), "vkQueueWaitIdle");
  const VkSwapchainCreateInfoKHR info =
      swapchain_info(surface_, format_, caps, extent, swapchain_.get());
  VkSwapchainKHR swapchain = VK_NULL_HANDLE;
  check(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &swapchain), "vkCreateSwapchainKHR");
  images_.clear();
  swapchain_ = UniqueSwapchain(device_, swapchain);
  extent_ = extent;
  requested_ = size;
  is_stale_ = false;
  ++generation_;
  create_images();
  return true;
}

void Presenter::create_images() {
  std::uint32_t count = 0;
  check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_.get(), &count, nullptr),
        "vkGetSwapchainImagesKHR");
  std::vector<VkImage> images(count);
  check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_.get(), &count, images.data()),
        "vkGetSwapchainImagesKHR");
  for (const VkImage image : images) {
    const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                     .pNext = nullptr,
                                     .flags = 0,
                                     .image = image,
                                     .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                     .format = format_.format,
                                     .components = {},
                                     .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device_.handle(), &info, nullptr, &view), "vkCreateImageView");
    images_.push_back({image, UniqueImageView(device_, view), create_semaphore(device_)});
  }
}

std::optional<Frame> Presenter::begin(VkExtent2D size) {
  if (is_empty(size)) return std::nullopt;
  FrameSlot& slot = slots_[slot_];
  device_.wait(slot.ticket);
  constexpr int kAttempts = 2;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if ((is_stale_ || differ(size, requested_)) && !recreate(size)) return std::nullopt;
    std::uint32_t index = 0;
    const VkResult result = vkAcquireNextImageKHR(device_.handle(), swapchain_.get(),
                                                  std::numeric_limits<std::uint64_t>::max(),
                                                  slot.acquired.get(), VK_NULL_HANDLE, &index);
    if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR) {
      is_stale_ = result == VK_SUBOPTIMAL_KHR;
      return record(index);
    }
    if (result != VK_ERROR_OUT_OF_DATE_KHR) check(result, "vkAcquireNextImageKHR");
    is_stale_ = true;
  }
  return std::nullopt;
}

Frame Presenter::record(std::uint32_t image_index) {
  FrameSlot& slot = slots_[slot_];
  check(vkResetCommandPool(device_.handle(), slot.pool.get(), 0), "vkResetCommandPool");
  const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                      .pNext = nullptr,
                                      .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
                                      .pInheritanceInfo = nullptr};
  check(vkBeginCommandBuffer(slot.commands, &info), "vkBeginCommandBuffer");
  const SwapchainImage& image = images_[image_index];
  return {slot.commands, image_index, image.image, image.view.get(), extent_};
}

void Presenter::submit(const Frame& frame) {
  FrameSlot& slot = slots_[slot_];
  const SwapchainImage& image = images_[frame.image_index];
  transition(frame.commands, frame.image, kColorAttachment, kPresent);
  check(vkEndCommandBuffer(frame.commands), "vkEndCommandBuffer");
  const VkSemaphore rendered = image.rendered.get();
  slot.ticket = device_.submit(frame.commands, slot.acquired.get(), rendered);
  slot_ = (slot_ + 1) % kFramesInFlight;
}

bool Presenter::present(const Frame& frame) {
  const VkSemaphore rendered = images_[frame.image_index].rendered.get();
  const VkSwapchainKHR swapchain = swapchain_.get();
  const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                              .pNext = nullptr,
                              .waitSemaphoreCount = 1,
                              .pWaitSemaphores = &rendered,
                              .swapchainCount = 1,
                              .pSwapchains = &swapchain,
                              .pImageIndices = &frame.image_index,
                              .pResults = nullptr};
  const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
  if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR) {
    is_stale_ = true;
  } else {
    check(result, "vkQueuePresentKHR");
  }
  return result != VK_ERROR_OUT_OF_DATE_KHR;
}

}  // namespace mesher::gpu
