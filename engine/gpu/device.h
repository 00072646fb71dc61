#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include "engine/gpu/instance.h"

namespace mesher::gpu {

struct DeviceOptions {
  /// Empty: the best one (discrete, integrated, virtual, CPU). A number: that position in
  /// Instance::devices(). Anything else: the first whose name contains it, in any case.
  std::string select{};
  /// The device must be able to present to it; null for pictures only.
  VkSurfaceKHR surface = VK_NULL_HANDLE;
};

/// A point on the device's time line: each submission has the next one.
using Ticket = std::uint64_t;

/// A logical device with one queue for everything, and the time line of what was submitted to it.
/// Used from one thread at a time. Outlives all that is made from it.
class Device {
 public:
  /// Throws DeviceError where no device is usable or none matches `select` (the message lists what
  /// there is).
  explicit Device(const Instance& instance, const DeviceOptions& options = {});
  /// Waits for everything submitted.
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkInstance instance() const { return instance_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  VkQueue queue() const { return queue_; }
  std::uint32_t queue_family() const { return queue_family_; }
  const VkPhysicalDeviceProperties& properties() const { return properties_; }
  const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
  std::string name() const { return properties_.deviceName; }
  /// Largest buffer that can be made, in bytes.
  VkDeviceSize max_buffer_bytes() const { return max_buffer_bytes_; }
  /// Largest piece of memory that one image or buffer can have, in bytes.
  VkDeviceSize max_allocation_bytes() const { return max_allocation_bytes_; }
  /// `wanted` if color and depth attachments can have so many samples, otherwise 1.
  VkSampleCountFlagBits supported_samples(std::uint32_t wanted) const;

  /// Submits `commands`; optionally waits for `wait` (at color output and transfer) and signals
  /// `signal`. Throws DeviceError.
  Ticket submit(VkCommandBuffer commands, VkSemaphore wait = VK_NULL_HANDLE,
                VkSemaphore signal = VK_NULL_HANDLE);
  /// Blocks until the submission with this ticket is done (0 is), then destroys what it held up.
  void wait(Ticket ticket);
  void wait_idle() { wait(submitted_); }
  Ticket submitted() const { return submitted_; }

  /// Runs `destroy` once everything submitted so far is done: what a handle's destructor calls.
  void retire(std::function<void(VkDevice)> destroy);

  /// Records and submits work that is not part of a frame, and waits for it.
  void run_once(const std::function<void(VkCommandBuffer)>& record);

 private:
  void create(const DeviceOptions& options);
  void collect(Ticket completed);

  struct Retired {
    Ticket ticket;
    std::function<void(VkDevice)> destroy;
  };

  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t queue_family_ = 0;
  VkPhysicalDeviceProperties properties_{};
  VkPhysicalDeviceMemoryProperties memory_{};
  VkDeviceSize max_buffer_bytes_ = 0;
  VkDeviceSize max_allocation_bytes_ = 0;
  VkCommandPool once_pool_ = VK_NULL_HANDLE;
  VkSemaphore timeline_ = VK_NULL_HANDLE;
  Ticket submitted_ = 0;
  std::deque<Retired> retired_;
};

}  // namespace mesher::gpu
