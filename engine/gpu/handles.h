#pragma once

#include <vulkan/vulkan_core.h>

#include <utility>

#include "engine/gpu/device.h"

namespace mesher::gpu {

/// Owns a Vulkan object created from a device. Destroys it after all work submitted earlier has
/// finished.
template <class T, void(VKAPI_PTR* Destroy)(VkDevice, T, const VkAllocationCallbacks*)>
class Unique {
 public:
  Unique() = default;
  Unique(Device& device, T handle) : device_(&device), handle_(handle) {}
  Unique(Unique&& other) noexcept
      : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
  Unique& operator=(Unique&& other) noexcept {
    if (this != &other) {
      reset();
      device_ = other.device_;
      handle_ = std::exchange(other.handle_, VK_NULL_HANDLE);
    }
    return *this;
  }
  ~Unique() { reset(); }

  T get() const { return handle_; }
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }
  void reset() {
    if (handle_ == VK_NULL_HANDLE) return;
    const T handle = std::exchange(handle_, VK_NULL_HANDLE);
    device_->retire([handle](VkDevice device) { Destroy(device, handle, nullptr); });
  }

 private:
  Device* device_ = nullptr;
  T handle_ = VK_NULL_HANDLE;
};

using UniqueMemory = Unique<VkDeviceMemory, vkFreeMemory>;
using UniqueBuffer = Unique<VkBuffer, vkDestroyBuffer>;
using UniqueImage = Unique<VkImage, vkDestroyImage>;
using UniqueImageView = Unique<VkImageView, vkDestroyImageView>;
using UniqueShader = Unique<VkShaderModule, vkDestroyShaderModule>;
using UniquePipelineLayout = Unique<VkPipelineLayout, vkDestroyPipelineLayout>;
using UniquePipeline = Unique<VkPipeline, vkDestroyPipeline>;
using UniqueSampler = Unique<VkSampler, vkDestroySampler>;
using UniqueSetLayout = Unique<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using UniqueDescriptorPool = Unique<VkDescriptorPool, vkDestroyDescriptorPool>;
using UniqueSemaphore = Unique<VkSemaphore, vkDestroySemaphore>;
using UniqueCommandPool = Unique<VkCommandPool, vkDestroyCommandPool>;
using UniqueSwapchain = Unique<VkSwapchainKHR, vkDestroySwapchainKHR>;

}  // namespace mesher::gpu
