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

/// Makes `buffer` hold all of `source`, in a new buffer where the size differs.
void upload_whole(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                  VkBufferUsageFlags usage, UploadStats& stats);

/// Copies elements of `source`, which the whole of `buffer` mirrors. Pre: the ranges are as
/// ChangeLog::merged returns them.
void upload_ranges(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                   std::span<const ChangedRange> ranges, std::size_t element_bytes,
                   UploadStats& stats);

/// Ranges of changed elements so near each other that one copy of both is cheaper than two.
std::uint32_t worthwhile_gap(std::size_t element_bytes);

}  // namespace mesher::render
