#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>

#include "engine/core/error.h"

namespace mesher::gpu {

/// Returns the name of a result from the Vulkan standard, for example
/// "VK_ERROR_OUT_OF_DEVICE_MEMORY", or "VkResult -42" if unknown.
std::string result_name(VkResult result);

/// Thrown when the device or the surface of a window is lost. Everything that was made from it has
/// to be made again, from another one.
class LostError : public DeviceError {
 public:
  using DeviceError::DeviceError;
};

/// Thrown when the GPU has no memory left for something. Everything else is as before.
class OutOfMemoryError : public DeviceError {
 public:
  using DeviceError::DeviceError;
};

/// Throws a DeviceError that names the call and the result, unless `result` is VK_SUCCESS:
/// LostError, OutOfMemoryError, or else "call: VK_ERROR_...".
void check(VkResult result, std::string_view call);

}  // namespace mesher::gpu
