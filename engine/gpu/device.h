#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include "engine/gpu/instance.h"

namespace mesher::gpu {

struct DeviceOptions {
  /// Empty: the best device (in the order discrete, integrated, virtual, CPU). A number: the index
  /// in Instance::devices(). Anything else: the first device whose name contains it, in any case.
  std::string select{};
  /// The surface that the device must be able to present to. Null: images only.
  VkSurfaceKHR surface = VK_NULL_HANDLE;
};

/// A point on the device's timeline. Each submission gets the next ticket.
using Ticket = std::uint64_t;

/// A logical device with one queue for all work and the timeline of its submissions. Pre: used from
/// one thread at a time. Must outlive everything created from it.
class Device {
 public:
  /// Throws DeviceError if no device is usable or none matches `select`. The message lists the
  /// devices.
  explicit Device(const Instance& instance, const DeviceOptions& options = {});
  /// Waits for all submitted work.
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
  /// Returns the largest possible buffer, in bytes.
  VkDeviceSize max_buffer_bytes() const { return max_buffer_bytes_; }
  /// Returns the largest memory allocation for one image or buffer, in bytes.
  VkDeviceSize max_allocation_bytes() const { return max_allocation_bytes_; }
  /// Returns `wanted` if color and depth attachments support that many samples, otherwise 1.
  VkSampleCountFlagBits supported_samples(std::uint32_t wanted) const;

  /// Submits `commands`. Optionally waits for `wait` (at color output and transfer) and signals
  /// `signal`. Throws DeviceError.
  Ticket submit(VkCommandBuffer commands, VkSemaphore wait = VK_NULL_HANDLE,
                VkSemaphore signal = VK_NULL_HANDLE);
  /// Blocks until the submission with this ticket has finished (ticket 0 has), then destroys the
  /// objects that waited for it.
  void wait(Ticket ticket);
  void wait_idle() { wait(submitted_); }
  Ticket submitted() const { return submitted_; }

  /// Runs `destroy` after all work submitted so far has finished. Handle destructors call it.
  void retire(std::function<void(VkDevice)> destroy);

  /// Records and submits work outside a frame, and waits for it.
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
