#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/gpu/instance.h"

namespace mesher::gpu {

/// A physical device and whether it will do.
struct Candidate {
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  /// One that draws and copies, and presents where there is a surface.
  std::uint32_t queue_family = 0;
  DeviceDescription description;
};

/// Every device the drivers show, in their order. `surface` may be null.
std::vector<Candidate> list_candidates(VkInstance instance, VkSurfaceKHR surface);

/// The one that `DeviceOptions::select` means. Throws DeviceError, listing what there is.
const Candidate& choose(const std::vector<Candidate>& candidates, std::string_view select);

}  // namespace mesher::gpu
