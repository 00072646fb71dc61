#include "engine/gpu/device.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "engine/gpu/result.h"
#include "engine/gpu/selection.h"

namespace mesher::gpu {
namespace {

VkSemaphoreSubmitInfo at(VkSemaphore semaphore, Ticket value, VkPipelineStageFlags2 stage) {
  return {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
          .pNext = nullptr,
          .semaphore = semaphore,
          .value = value,
          .stageMask = stage,
          .deviceIndex = 0};
}

VkDevice create_device(const Candidate& chosen, bool presents) {
  VkPhysicalDeviceVulkan13Features features13{};
  features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  features13.synchronization2 = VK_TRUE;
  features13.dynamicRendering = VK_TRUE;
  VkPhysicalDeviceVulkan12Features features12{};
  features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  features12.pNext = &features13;
  features12.bufferDeviceAddress = VK_TRUE;
  features12.timelineSemaphore = VK_TRUE;

  const float priority = 1.0F;
  const VkDeviceQueueCreateInfo queue{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                      .pNext = nullptr,
                                      .flags = 0,
                                      .queueFamilyIndex = chosen.queue_family,
                                      .queueCount = 1,
                                      .pQueuePriorities = &priority};
  const char* const swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
  const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                .pNext = &features12,
                                .flags = 0,
                                .queueCreateInfoCount = 1,
                                .pQueueCreateInfos = &queue,
                                .enabledLayerCount = 0,
                                .ppEnabledLayerNames = nullptr,
                                .enabledExtensionCount = presents ? 1U : 0U,
                                .ppEnabledExtensionNames = &swapchain,
                                .pEnabledFeatures = nullptr};
  VkDevice device = VK_NULL_HANDLE;
  check(vkCreateDevice(chosen.physical, &info, nullptr, &device), "vkCreateDevice");
  return device;
}

VkSemaphore create_timeline(VkDevice device) {
  const VkSemaphoreTypeCreateInfo type{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                       .pNext = nullptr,
                                       .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE,
                                       .initialValue = 0};
  const VkSemaphoreCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type, .flags = 0};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(device, &info, nullptr, &semaphore), "vkCreateSemaphore");
  return semaphore;
}

}  // namespace

Device::Device(const Instance& instance, const DeviceOptions& options)
    : instance_(instance.handle()) {
  try {
    create(options);
  } catch (...) {
    if (device_ != VK_NULL_HANDLE) vkDestroyDevice(device_, nullptr);
    throw;
  }
}

void Device::create(const DeviceOptions& options) {
  const std::vector<Candidate> candidates = list_candidates(instance_, options.surface);
  const Candidate& chosen = choose(candidates, options.select);
  physical_ = chosen.physical;
  queue_family_ = chosen.queue_family;
  VkPhysicalDeviceVulkan13Properties properties13{};
  properties13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES;
  VkPhysicalDeviceVulkan11Properties properties11{};
  properties11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
  properties11.pNext = &properties13;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &properties11;
  vkGetPhysicalDeviceProperties2(physical_, &properties);
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
  properties_ = properties.properties;
  max_allocation_bytes_ = properties11.maxMemoryAllocationSize;
  max_buffer_bytes_ = std::min(properties13.maxBufferSize, max_allocation_bytes_);

  device_ = create_device(chosen, options.surface != VK_NULL_HANDLE);
  vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
  timeline_ = create_timeline(device_);
  const VkCommandPoolCreateInfo pool{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                     .pNext = nullptr,
                                     .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                     .queueFamilyIndex = queue_family_};
  const VkResult result = vkCreateCommandPool(device_, &pool, nullptr, &once_pool_);
  if (result != VK_SUCCESS) vkDestroySemaphore(device_, timeline_, nullptr);
  check(result, "vkCreateCommandPool");
}

Device::~Device() {
  // Not wait_idle(): a destructor must not throw, and a lost device is destroyed in the same way.
  vkDeviceWaitIdle(device_);
  collect(std::numeric_limits<Ticket>::max());
  vkDestroyCommandPool(device_, once_pool_, nullptr);
  vkDestroySemaphore(device_, timeline_, nullptr);
  vkDestroyDevice(device_, nullptr);
}

VkSampleCountFlagBits Device::supported_samples(std::uint32_t wanted) const {
  const VkSampleCountFlags supported = properties_.limits.framebufferColorSampleCounts &
                                       properties_.limits.framebufferDepthSampleCounts;
  return (supported & wanted) == wanted && wanted == VK_SAMPLE_COUNT_4_BIT ? VK_SAMPLE_COUNT_4_BIT
                                                                           : VK_SAMPLE_COUNT_1_BIT;
}

Ticket Device::submit(VkCommandBuffer commands, VkSemaphore wait, VkSemaphore signal) {
  const VkSemaphoreSubmitInfo waits = at(
      wait, 0, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_2_TRANSFER_BIT);
  const std::array signals{at(timeline_, submitted_ + 1, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT),
                           at(signal, 0, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT)};
  const VkCommandBufferSubmitInfo buffer{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                         .pNext = nullptr,
                                         .commandBuffer = commands,
                                         .deviceMask = 0};
  const VkSubmitInfo2 info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                           .pNext = nullptr,
                           .flags = 0,
                           .waitSemaphoreInfoCount = wait == VK_NULL_HANDLE ? 0U : 1U,
                           .pWaitSemaphoreInfos = &waits,
                           .commandBufferInfoCount = 1,
                           .pCommandBufferInfos = &buffer,
                           .signalSemaphoreInfoCount = signal == VK_NULL_HANDLE ? 1U : 2U,
                           .pSignalSemaphoreInfos = signals.data()};
  check(vkQueueSubmit2(queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
  return ++submitted_;
}

void Device::wait(Ticket ticket) {
  const VkSemaphoreWaitInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                 .pNext = nullptr,
                                 .flags = 0,
                                 .semaphoreCount = 1,
                                 .pSemaphores = &timeline_,
                                 .pValues = &ticket};
  check(vkWaitSemaphores(device_, &info, std::numeric_limits<std::uint64_t>::max()),
        "vkWaitSemaphores");
  collect(ticket);
}

void Device::retire(std::function<void(VkDevice)> destroy) {
  retired_.push_back({submitted_, std::move(destroy)});
}

void Device::collect(Ticket completed) {
  while (!retired_.empty() && retired_.front().ticket <= completed) {
    retired_.front().destroy(device_);
    retired_.pop_front();
  }
}

void Device::run_once(const std::function<void(VkCommandBuffer)>& record) {
  const VkCommandBufferAllocateInfo allocate{
      .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
      .pNext = nullptr,
      .commandPool = once_pool_,
      .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
      .commandBufferCount = 1};
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device_, &allocate, &commands), "vkAllocateCommandBuffers");
  // Freed after this submission, whether it succeeds or fails.
  const auto free = [this, commands] {
    retire([pool = once_pool_, commands](VkDevice device) {
      vkFreeCommandBuffers(device, pool, 1, &commands);
    });
  };
  try {
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .pNext = nullptr,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
                                         .pInheritanceInfo = nullptr};
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    record(commands);
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    submit(commands);
  } catch (...) {
    free();
    throw;
  }
  free();
  wait_idle();
}

}  // namespace mesher::gpu
