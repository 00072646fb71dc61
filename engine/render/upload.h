#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/gpu/buffer.h"
#include "engine/mesh/change_log.h"

namespace mesher::render {

/// What bringing a mirror up to date cost.
struct UploadStats {
  std::uint64_t uploaded_bytes = 0;
  std::uint64_t total_bytes = 0;  ///< size of the whole mirror
  std::uint32_t ranges = 0;       ///< pieces copied
};

/// Puts an empty buffer of at least `bytes` bytes in place of one that is smaller; one that was
/// filled before gets half as much again, so that what grows bit by bit is seldom copied whole.
/// Returns whether it did.
bool make_room(gpu::Device& device, gpu::Buffer& buffer, std::size_t bytes,
               VkBufferUsageFlags usage);

/// Makes `buffer` hold all of `source` from its start, with room made where it is too small.
void upload_whole(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                  VkBufferUsageFlags usage, UploadStats& stats);

/// Elements of a mirrored array that have changed.
struct ChangedElements {
  const ChangeLog& log;
  GpuArray array;  ///< whose list of the log counts
  std::size_t element_bytes;
};

/// Brings the start of `buffer` up to date with `source`: what has changed of it; or all of it
/// where all has, the buffer is too small, or the pieces are so many that one copy is cheaper. What
/// lies past the end of `source` stays: room to grow again.
void upload_changes(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                    const ChangedElements& changed, VkBufferUsageFlags usage, UploadStats& stats);

}  // namespace mesher::render
