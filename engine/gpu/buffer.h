#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/gpu/memory.h"

namespace mesher::gpu {

/// A range of a buffer, in bytes.
struct ByteRange {
  VkDeviceSize begin = 0;
  VkDeviceSize end = 0;
  VkDeviceSize size() const { return end - begin; }
};

/// A buffer with its own memory. Shaders read it at `address()`.
class Buffer {
 public:
  /// An empty buffer without a handle.
  Buffer() = default;
  /// Creates a buffer of `bytes` bytes. `usage` is VK_BUFFER_USAGE_VERTEX_BUFFER_BIT or the like;
  /// transfer and shader-address usage are added. Throws DeviceError if `bytes` exceeds what the
  /// device supports.
  Buffer(Device& device, VkDeviceSize bytes, VkBufferUsageFlags usage, MemoryIntent intent);

  VkBuffer handle() const { return buffer_.get(); }
  VkDeviceSize size() const { return size_; }
  VkDeviceAddress address() const { return address_; }
  std::byte* mapped() const { return memory_.mapped; }
  explicit operator bool() const { return static_cast<bool>(buffer_); }

 private:
  Memory memory_;
  UniqueBuffer buffer_;  // after memory_, so destroyed first
  VkDeviceSize size_ = 0;
  VkDeviceAddress address_ = 0;
};

/// Copies the given ranges of `source`, which mirrors the whole of `buffer`, and waits until no
/// frame can be reading the old bytes.
///
/// Copies directly if the buffer is mapped, otherwise through one staging copy. Pre: ranges are
/// sorted, disjoint and within both.
void upload(Device& device, Buffer& buffer, std::span<const std::byte> source,
            std::span<const ByteRange> ranges);
/// Uploads through one staging copy, for memory that the CPU cannot map; works on any memory.
/// upload() falls back to it.
void upload_by_staging(Device& device, Buffer& buffer, std::span<const std::byte> source,
                       std::span<const ByteRange> ranges);
/// Uploads the whole of `source` to the start of `buffer`.
void upload(Device& device, Buffer& buffer, std::span<const std::byte> source);

/// Returns the first `bytes` bytes of `buffer` after the GPU has finished with it. For tests.
std::vector<std::byte> download(Device& device, const Buffer& buffer, VkDeviceSize bytes);

}  // namespace mesher::gpu
