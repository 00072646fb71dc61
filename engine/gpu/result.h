#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>

namespace mesher::gpu {

/// Returns the name of a result from the Vulkan standard, for example
/// "VK_ERROR_OUT_OF_DEVICE_MEMORY", or "VkResult -42" if unknown.
std::string result_name(VkResult result);

/// Throws DeviceError "call: VK_ERROR_..." unless `result` is VK_SUCCESS.
void check(VkResult result, std::string_view call);

}  // namespace mesher::gpu
