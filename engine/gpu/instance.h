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
  /// What the window system needs (glfwGetRequiredInstanceExtensions); none for pictures only.
  std::vector<const char*> extensions{};
  /// Validation with synchronization checks, collected in `Instance::messages`. A machine without
  /// the layer is an error: a test that believes it validates must not pass in silence.
  bool validation = false;
};

/// What `mesher --device ?` lists.
struct DeviceDescription {
  std::string name;
  std::string kind;  ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU" or "other"
  std::string api_version;
  bool is_usable = false;  ///< has Vulkan 1.3 and all that mesher asks for
};

/// A connection to the Vulkan loader. Outlives every Surface and Device made from it.
class Instance {
 public:
  /// Throws DeviceError where there is no loader, no driver, no Vulkan 1.3, or an extension lacks.
  explicit Instance(const InstanceOptions& options = {});
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return instance_; }
  /// In the driver's order: the position here is the index that `DeviceOptions::select` takes.
  std::vector<DeviceDescription> devices() const;
  /// Empty unless InstanceOptions::validation.
  const ValidationMessages& messages() const { return *messages_; }
  ValidationMessages& messages() { return *messages_; }

 private:
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::unique_ptr<ValidationMessages> messages_;
};

/// Owns a VkSurfaceKHR that the window library made. Outlives the swapchain on it.
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
