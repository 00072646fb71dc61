#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/gpu/memory.h"

namespace mesher::gpu {

/// A piece of a buffer, in bytes.
struct ByteRange {
  VkDeviceSize begin = 0;
  VkDeviceSize end = 0;
  VkDeviceSize size() const { return end - begin; }
};

/// A buffer with memory of its own, readable by shaders at `address()`.
class Buffer {
 public:
  /// No bytes, no handle.
  Buffer() = default;
  /// `usage` says VK_BUFFER_USAGE_VERTEX_BUFFER_BIT and the like; transfer and shader address come
  /// by themselves. Throws DeviceError where `bytes` is beyond the device.
  Buffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, MemoryIntent intent);

  VkBuffer handle() const { return buffer_.get(); }
  VkDeviceSize size() const { return size_; }
  VkDeviceAddress address() const { return address_; }
  std::byte* mapped() const { return memory_.mapped; }
  explicit operator bool() const { return static_cast<bool>(buffer_); }

 private:
  Memory memory_;
  UniqueBuffer buffer_;  // after memory_: goes before it
  VkDeviceSize size_ = 0;
  VkDeviceAddress address_ = 0;
};

/// Copies the given ranges of `source`, which mirrors the whole of `buffer`, and waits until no
/// frame can be reading the old bytes. Directly where the buffer is mapped, otherwise by one
/// staging copy. Pre: ranges are sorted, disjoint and within both.
void upload(Device& device, Buffer& buffer, std::span<const std::byte> source,
            std::span<const ByteRange> ranges);
/// The same for memory that the CPU cannot reach, in one staging copy; works on any. What upload()
/// falls back on.
void upload_by_staging(Device& device, Buffer& buffer, std::span<const std::byte> source,
                       std::span<const ByteRange> ranges);
/// The whole of `source` to the start of `buffer`.
void upload(Device& device, Buffer& buffer, std::span<const std::byte> source);

/// The first `bytes` bytes of `buffer`, once the GPU is done with it. For tests.
std::vector<std::byte> download(Device& device, const Buffer& buffer, VkDeviceSize bytes);

}  // namespace mesher::gpu
