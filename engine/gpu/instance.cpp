#include "engine/gpu/instance.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "engine/core/error.h"
#include "engine/gpu/leak_check.h"
#include "engine/gpu/result.h"
#include "engine/gpu/selection.h"

namespace mesher::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                               VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data,
                                               void* messages) {
  // Newer layers no longer begin the text with the name of the rule.
  std::string text = data->pMessage;
  const std::string rule = data->pMessageIdName != nullptr ? data->pMessageIdName : "";
  if (text.find(rule) == std::string::npos) text = rule + ": " + text;
  static_cast<ValidationMessages*>(messages)->add(text);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationMessages* messages) {
  return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
          .pNext = nullptr,
          .flags = 0,
          .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                             VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
          .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
          .pfnUserCallback = collect_message,
          .pUserData = messages};
}

bool has_validation_layer() {
  std::uint32_t count = 0;
  check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
  std::vector<VkLayerProperties> layers(count);
  check(vkEnumerateInstanceLayerProperties(&count, layers.data()),
        "vkEnumerateInstanceLayerProperties");
  return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, kValidationLayer) == 0;
  });
}

VkInstance create_instance(const InstanceOptions& options, ValidationMessages* messages) {
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                      .pNext = nullptr,
                                      .pApplicationName = "mesher",
                                      .applicationVersion = 0,
                                      .pEngineName = "mesher",
                                      .engineVersion = 0,
                                      .apiVersion = VK_API_VERSION_1_3};
  constexpr std::array kEnabled{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  // Chained to the instance too, so that its creation is validated.
  const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(messages);
  const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                         .pNext = &messenger,
                                         .enabledValidationFeatureCount = kEnabled.size(),
                                         .pEnabledValidationFeatures = kEnabled.data(),
                                         .disabledValidationFeatureCount = 0,
                                         .pDisabledValidationFeatures = nullptr};
  std::vector<const char*> extensions = options.extensions;
  if (options.validation) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  const VkInstanceCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
      .pNext = options.validation ? &features : nullptr,
      .flags = 0,
      .pApplicationInfo = &application,
      .enabledLayerCount = options.validation ? 1U : 0U,
      .ppEnabledLayerNames = &kValidationLayer,
      .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
      .ppEnabledExtensionNames = extensions.data()};
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
    throw DeviceError("no Vulkan driver found (Debian: install mesa-vulkan-drivers)");
  }
  check(result, "vkCreateInstance");
  return instance;
}

template <class Function>
Function load(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

void ValidationMessages::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::size_t ValidationMessages::count() const {
  const std::lock_guard lock(mutex_);
  return messages_.size();
}

std::vector<std::string> ValidationMessages::list() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

void ValidationMessages::clear() {
  const std::lock_guard lock(mutex_);
  messages_.clear();
}

Instance::Instance(const InstanceOptions& options)
    : messages_(std::make_unique<ValidationMessages>()) {
  std::uint32_t version = VK_API_VERSION_1_0;
  check(vkEnumerateInstanceVersion(&version), "vkEnumerateInstanceVersion");
  if (version < VK_API_VERSION_1_3) throw DeviceError("the Vulkan loader is older than 1.3");
  if (options.validation && !has_validation_layer()) {
    throw DeviceError("no Vulkan validation layer (Debian: install vulkan-validationlayers)");
  }
  suppress_third_party_leaks(options.validation);
  instance_ = create_instance(options, messages_.get());
  if (!options.validation) return;
  const VkDebugUtilsMessengerCreateInfoEXT info = messenger_info(messages_.get());
  const VkResult result = load<PFN_vkCreateDebugUtilsMessengerEXT>(
      instance_, "vkCreateDebugUtilsMessengerEXT")(instance_, &info, nullptr, &messenger_);
  if (result != VK_SUCCESS) vkDestroyInstance(instance_, nullptr);
  check(result, "vkCreateDebugUtilsMessengerEXT");
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    load<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(
        instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

std::vector<DeviceDescription> Instance::devices() const {
  std::vector<DeviceDescription> descriptions;
  for (const Candidate& candidate : list_candidates(instance_, VK_NULL_HANDLE)) {
    descriptions.push_back(candidate.description);
  }
  return descriptions;
}

Surface::~Surface() {
  vkDestroySurfaceKHR(instance_, surface_, nullptr);
}

}  // namespace mesher::gpu
