#include "engine/gpu/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/gpu/result.h"

namespace mesher::gpu {
namespace {

constexpr VkMemoryPropertyFlags kMapped =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

std::optional<std::uint32_t> find_type(const VkPhysicalDeviceMemoryProperties& memory,
                                       std::uint32_t allowed, VkMemoryPropertyFlags wanted) {
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    const bool is_allowed = (allowed >> i & 1U) != 0;
    if (is_allowed && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  }
  return std::nullopt;
}

/// Returns whether a memory type is in the largest heap. A discrete card without resizable BAR maps
/// only a 256 MB window, which is too small for meshes.
bool is_in_largest_heap(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t type) {
  VkDeviceSize largest = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) == 0) continue;
    largest = std::max(largest, memory.memoryHeaps[i].size);
  }
  return memory.memoryHeaps[memory.memoryTypes[type].heapIndex].size == largest;
}

std::optional<std::uint32_t> choose_type(const VkPhysicalDeviceMemoryProperties& memory,
                                         std::uint32_t allowed, MemoryIntent intent) {
  switch (intent) {
    case MemoryIntent::fixed: {
      const auto both = find_type(memory, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | kMapped);
      if (both && is_in_largest_heap(memory, *both)) return both;
      const auto local = find_type(memory, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
      return local ? local : find_type(memory, allowed, 0);
    }
    case MemoryIntent::readback: {
      const auto cached = find_type(memory, allowed, kMapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
      if (cached) return cached;
      break;
    }
    case MemoryIntent::dynamic:
      break;
  }
  return find_type(memory, allowed, kMapped);
}

}  // namespace

Memory allocate(Device& device, const VkMemoryRequirements& requirements, MemoryIntent intent,
                bool with_address) {
  if (requirements.size > device.max_allocation_bytes()) {
    throw DeviceError(fmt::format("{} cannot allocate {} at once; the limit is {}", device.name(),
                                  bytes_text(requirements.size),
                                  bytes_text(device.max_allocation_bytes())));
  }
  const auto type = choose_type(device.memory(), requirements.memoryTypeBits, intent);
  if (!type) throw DeviceError("the Vulkan device has no suitable memory type");
  const VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                        .pNext = nullptr,
                                        .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT,
                                        .deviceMask = 0};
  const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                  .pNext = with_address ? &flags : nullptr,
                                  .allocationSize = requirements.size,
                                  .memoryTypeIndex = *type};
  VkDeviceMemory handle = VK_NULL_HANDLE;
  check(vkAllocateMemory(device.handle(), &info, nullptr, &handle), "vkAllocateMemory");
  Memory memory{UniqueMemory(device, handle), nullptr};
  if ((device.memory().memoryTypes[*type].propertyFlags & kMapped) == kMapped) {
    void* mapped = nullptr;
    check(vkMapMemory(device.handle(), handle, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    memory.mapped = static_cast<std::byte*>(mapped);
  }
  return memory;
}

}  // namespace mesher::gpu
