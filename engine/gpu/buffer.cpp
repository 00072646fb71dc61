#include "engine/gpu/buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "engine/core/assert.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/gpu/memory_barrier.h"
#include "engine/gpu/result.h"

namespace mesher::gpu {
namespace {

/// Waits for all earlier work and makes its writes visible to all later work. For transfers outside
/// frames, where a finer barrier would gain nothing.
void full_barrier(VkCommandBuffer commands) {
  memory_barrier(
      commands, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT},
      {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
       VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_HOST_READ_BIT});
}

VkDeviceSize total_size(std::span<const ByteRange> ranges, [[maybe_unused]] VkDeviceSize limit) {
  VkDeviceSize total = 0;
  for (const ByteRange range : ranges) {
    MESHER_ASSERT(range.begin <= range.end && range.end <= limit);
    total += range.size();
  }
  return total;
}

}  // namespace

Buffer::Buffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, MemoryIntent intent)
    : size_(bytes) {
  if (bytes == 0) return;
  if (bytes > device.max_buffer_bytes()) {
    throw DeviceError(
        fmt::format("the mesh is too large for {}: it needs a buffer of {}, and the limit is {}",
                    device.name(), bytes_text(bytes), bytes_text(device.max_buffer_bytes())));
  }
  const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                .pNext = nullptr,
                                .flags = 0,
                                .size = bytes,
                                .usage = usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                         VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                .queueFamilyIndexCount = 0,
                                .pQueueFamilyIndices = nullptr};
  VkBuffer handle = VK_NULL_HANDLE;
  check(vkCreateBuffer(device.handle(), &info, nullptr, &handle), "vkCreateBuffer");
  buffer_ = UniqueBuffer(device, handle);
  VkMemoryRequirements requirements{};
  vkGetBufferMemoryRequirements(device.handle(), handle, &requirements);
  memory_ = allocate(device, requirements, intent, true);
  check(vkBindBufferMemory(device.handle(), handle, memory_.handle.get(), 0), "vkBindBufferMemory");
  const VkBufferDeviceAddressInfo address{
      .sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, .pNext = nullptr, .buffer = handle};
  address_ = vkGetBufferDeviceAddress(device.handle(), &address);
}

void upload_by_staging(Device& device, Buffer& buffer, std::span<const std::byte> source,
                       std::span<const ByteRange> ranges) {
  const VkDeviceSize total =
      total_size(ranges, std::min<VkDeviceSize>(source.size(), buffer.size()));
  if (total == 0) return;
  const Buffer staging(device, total, 0, MemoryIntent::dynamic);
  std::vector<VkBufferCopy> regions;
  regions.reserve(ranges.size());
  VkDeviceSize offset = 0;
  for (const ByteRange range : ranges) {
    if (range.size() == 0) continue;
    std::memcpy(staging.mapped() + offset, source.data() + range.begin, range.size());
    regions.push_back({offset, range.begin, range.size()});
    offset += range.size();
  }
  device.run_once([&](VkCommandBuffer commands) {
    full_barrier(commands);
    vkCmdCopyBuffer(commands, staging.handle(), buffer.handle(),
                    static_cast<std::uint32_t>(regions.size()), regions.data());
    full_barrier(commands);
  });
}

void upload(Device& device, Buffer& buffer, std::span<const std::byte> source,
            std::span<const ByteRange> ranges) {
  if (total_size(ranges, std::min<VkDeviceSize>(source.size(), buffer.size())) == 0) return;
  if (buffer.mapped() == nullptr) return upload_by_staging(device, buffer, source, ranges);
  device.wait_idle();
  for (const ByteRange range : ranges) {
    std::memcpy(buffer.mapped() + range.begin, source.data() + range.begin, range.size());
  }
}

void upload(Device& device, Buffer& buffer, std::span<const std::byte> source) {
  const ByteRange whole{0, source.size()};
  upload(device, buffer, source, {&whole, 1});
}

std::vector<std::byte> download(Device& device, const Buffer& buffer, VkDeviceSize bytes) {
  MESHER_ASSERT(bytes <= buffer.size());
  std::vector<std::byte> content(bytes);
  if (bytes == 0) return content;
  const Buffer readback(device, bytes, 0, MemoryIntent::readback);
  device.run_once([&](VkCommandBuffer commands) {
    full_barrier(commands);
    const VkBufferCopy region{0, 0, bytes};
    vkCmdCopyBuffer(commands, buffer.handle(), readback.handle(), 1, &region);
    full_barrier(commands);
  });
  std::memcpy(content.data(), readback.mapped(), bytes);
  return content;
}

}  // namespace mesher::gpu
