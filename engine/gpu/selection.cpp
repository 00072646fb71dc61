#include "engine/gpu/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/gpu/result.h"

namespace mesher::gpu {
namespace {

std::string_view kind_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "CPU";
    default:
      return "other";
  }
}

int rank(VkPhysicalDeviceType type) {
  constexpr std::array kBestFirst{VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU,
                                  VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
                                  VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_CPU};
  return static_cast<int>(std::find(kBestFirst.begin(), kBestFirst.end(), type) -
                          kBestFirst.begin());
}

bool has_swapchains(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& e) {
    return std::strcmp(e.extensionName, VK_KHR_SWAPCHAIN_EXTENSION_NAME) == 0;
  });
}

std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice physical, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  for (std::uint32_t i = 0; i < count; ++i) {
    if ((families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0) continue;
    VkBool32 presents = VK_TRUE;
    if (surface != VK_NULL_HANDLE &&
        vkGetPhysicalDeviceSurfaceSupportKHR(physical, i, surface, &presents) != VK_SUCCESS) {
      continue;
    }
    if (presents == VK_TRUE) return i;
  }
  return std::nullopt;
}

/// Describes a device. Features need no check, because Vulkan 1.3 requires drivers to have every
/// feature that mesher enables.
Candidate describe(VkPhysicalDevice physical, VkSurfaceKHR surface) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  const std::uint32_t version = properties.apiVersion;
  const std::optional<std::uint32_t> family = find_queue_family(physical, surface);
  Candidate candidate;
  candidate.physical = physical;
  candidate.type = properties.deviceType;
  candidate.queue_family = family.value_or(0);
  candidate.description.name = properties.deviceName;
  candidate.description.kind = kind_name(properties.deviceType);
  candidate.description.api_version =
      fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                  VK_API_VERSION_PATCH(version));
  candidate.description.is_usable = version >= VK_API_VERSION_1_3 && family.has_value() &&
                                    (surface == VK_NULL_HANDLE || has_swapchains(physical));
  return candidate;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::string list_names(const std::vector<Candidate>& candidates) {
  std::string names;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    names += fmt::format("{}{} {}", i == 0 ? "" : "; ", i, candidates[i].description.name);
  }
  return names;
}

const Candidate* best(const std::vector<Candidate>& candidates) {
  const Candidate* found = nullptr;
  for (const Candidate& candidate : candidates) {
    if (!candidate.description.is_usable) continue;
    if (found == nullptr || rank(candidate.type) < rank(found->type)) found = &candidate;
  }
  return found;
}

const Candidate* find(const std::vector<Candidate>& candidates, std::string_view select) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(select.data(), select.data() + select.size(), index);
  if (error == std::errc{} && end == select.data() + select.size()) {
    return index < candidates.size() ? &candidates[index] : nullptr;
  }
  const std::string wanted = lower(select);
  const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
    return lower(c.description.name).find(wanted) != std::string::npos;
  });
  return found == candidates.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Candidate> list_candidates(VkInstance instance, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
  std::vector<Candidate> candidates;
  candidates.reserve(count);
  for (const VkPhysicalDevice device : devices)
    candidates.push_back(describe(device, surface));
  return candidates;
}

const Candidate& choose(const std::vector<Candidate>& candidates, std::string_view select) {
  if (candidates.empty()) {
    throw DeviceError(
        "no Vulkan device found (Debian: mesa-vulkan-drivers includes one for any CPU)");
  }
  const Candidate* chosen = select.empty() ? best(candidates) : find(candidates, select);
  if (chosen == nullptr && select.empty()) {
    throw DeviceError(
        "no Vulkan device supports version 1.3 and the required features; available: " +
        list_names(candidates));
  }
  if (chosen == nullptr) {
    throw DeviceError("no Vulkan device matches '" + std::string(select) +
                      "'; available: " + list_names(candidates));
  }
  if (!chosen->description.is_usable) {
    throw DeviceError("Vulkan device '" + chosen->description.name +
                      "' is not usable: mesher needs Vulkan 1.3 (it has " +
                      chosen->description.api_version + "), graphics and presentation");
  }
  return *chosen;
}

}  // namespace mesher::gpu
