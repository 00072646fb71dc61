#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace mesher::gpu {

/// Warnings and errors of the validation layer, collected from any thread.
class ValidationMessages {
 public:
  void add(std::string message);
  std::size_t count() const;
  std::vector<std::string> list() const;
  void clear();

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

struct InstanceOptions {
  /// Extensions that the window system needs (glfwGetRequiredInstanceExtensions). Empty for images
  /// only.
  std::vector<const char*> extensions{};
  /// Validation with synchronization checks, collected in `Instance::messages`. A missing layer is
  /// an error: a test that relies on validation must not pass silently without it.
  bool validation = false;
};

/// A device as `mesher --device ?` lists it.
struct DeviceDescription {
  std::string name;
  std::string kind;  ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU" or "other"
  std::string api_version;
  bool is_usable = false;  ///< has Vulkan 1.3 and everything that mesher needs
};

/// A connection to the Vulkan loader. Must outlive every Surface and Device created from it.
class Instance {
 public:
  /// Throws DeviceError if there is no loader, no driver or no Vulkan 1.3, or if an extension is
  /// missing.
  explicit Instance(const InstanceOptions& options = {});
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return instance_; }
  /// Returns the devices in the driver's order. The index here is the index for
  /// `DeviceOptions::select`.
  std::vector<DeviceDescription> devices() const;
  /// Returns the validation messages. Empty unless InstanceOptions::validation is set.
  const ValidationMessages& messages() const { return *messages_; }
  ValidationMessages& messages() { return *messages_; }

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::unique_ptr<ValidationMessages> messages_;
};

/// Owns a VkSurfaceKHR created by the window library. Must outlive the swapchain on it.
class Surface {
 public:
  Surface(const Instance& instance, VkSurfaceKHR surface)
      : instance_(instance.handle()), surface_(surface) {}
  ~Surface();
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  VkSurfaceKHR handle() const { return surface_; }

 private:
  VkInstance instance_;
  VkSurfaceKHR surface_;
};

}  // namespace mesher::gpu
