#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <string_view>

namespace mesher::gpu {

/// The spelling of the standard: "VK_ERROR_OUT_OF_DEVICE_MEMORY"; "VkResult -42" for one unknown.
std::string result_name(VkResult result);

/// Throws DeviceError "call: VK_ERROR_..." unless `result` is VK_SUCCESS.
void check(VkResult result, std::string_view call);

}  // namespace mesher::gpu
