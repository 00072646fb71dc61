#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/gpu/instance.h"

namespace mesher::gpu {

/// A physical device and whether mesher can use it.
struct Candidate {
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
  /// A queue family that draws and copies, and presents if there is a surface.
  std::uint32_t queue_family = 0;
  DeviceDescription description;
};

/// Returns all devices of the drivers, in their order. `surface` may be null.
std::vector<Candidate> list_candidates(VkInstance instance, VkSurfaceKHR surface);

/// Returns the candidate that `DeviceOptions::select` names. Throws DeviceError with a list of the
/// devices.
const Candidate& choose(const std::vector<Candidate>& candidates, std::string_view select);

}  // namespace mesher::gpu
