#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/gpu/buffer.h"
#include "engine/mesh/change_log.h"

namespace mesher::render {

/// Cost of an update of a mirror.
struct UploadStats {
  std::uint64_t uploaded_bytes = 0;
  std::uint64_t total_bytes = 0;  ///< size of the whole mirror
  std::uint32_t ranges = 0;       ///< ranges copied
};

/// Replaces a buffer smaller than `bytes` with an empty one of at least `bytes` bytes and returns
/// whether it did. A non-empty buffer grows by at least half, so a buffer that grows gradually is
/// rarely copied whole.
bool make_room(gpu::Device& device, gpu::Buffer& buffer, std::size_t bytes,
               VkBufferUsageFlags usage);

/// Copies all of `source` to the start of `buffer`, and enlarges it if necessary.
void upload_whole(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                  VkBufferUsageFlags usage, UploadStats& stats);

/// The changed elements of a mirrored array.
struct ChangedElements {
  const ChangeLog& log;
  GpuArray array;  ///< selects the list of the log
  std::size_t element_bytes;
};

/// Updates the start of `buffer` from `source`.
///
/// Copies the changes only, or everything if all changed, the buffer is too small, or there are so
/// many ranges that one copy is cheaper. Data past the end of `source` stays: room to grow again.
void upload_changes(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                    const ChangedElements& changed, VkBufferUsageFlags usage, UploadStats& stats);

}  // namespace mesher::render
