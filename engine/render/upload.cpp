#include "engine/render/upload.h"

#include <algorithm>
#include <vector>

namespace mesher::render {
namespace {

/// Above this, many small copies cost more than the bytes they save.
constexpr std::size_t kMostRanges = 20'000;

/// Returns the largest gap, in elements, between two ranges that is cheaper to copy than to skip.
std::uint32_t worthwhile_gap(std::size_t element_bytes) {
  constexpr std::size_t kBytes = 64;  // a cache line
  return static_cast<std::uint32_t>(kBytes / element_bytes);
}

}  // namespace

bool make_room(gpu::Device& device, gpu::Buffer& buffer, std::size_t bytes,
               VkBufferUsageFlags usage) {
  if (buffer.size() >= bytes) return false;
  const VkDeviceSize grown = std::min(buffer.size() + buffer.size() / 2, device.max_buffer_bytes());
  buffer = {};  // freed first, so that both never coexist
  buffer =
      gpu::Buffer(device, std::max<VkDeviceSize>(bytes, grown), usage, gpu::MemoryIntent::fixed);
  return true;
}

void upload_whole(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                  VkBufferUsageFlags usage, UploadStats& stats) {
  make_room(device, buffer, source.size(), usage);
  if (source.empty()) return;
  gpu::upload(device, buffer, source);
  stats.uploaded_bytes += source.size();
  ++stats.ranges;
}

void upload_changes(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                    const ChangedElements& changed, VkBufferUsageFlags usage, UploadStats& stats) {
  const auto count = static_cast<std::uint32_t>(source.size() / changed.element_bytes);
  const std::vector<ChangedRange> ranges =
      changed.log.merged(changed.array, worthwhile_gap(changed.element_bytes), count);
  if (changed.log.is_whole(changed.array) || buffer.size() < source.size() ||
      ranges.size() > kMostRanges) {
    return upload_whole(device, buffer, source, usage, stats);
  }
  std::vector<gpu::ByteRange> bytes;
  bytes.reserve(ranges.size());
  for (const ChangedRange range : ranges) {
    bytes.push_back({range.begin * changed.element_bytes, range.end * changed.element_bytes});
    stats.uploaded_bytes += bytes.back().size();
  }
  stats.ranges += static_cast<std::uint32_t>(bytes.size());
  gpu::upload(device, buffer, source, bytes);
}

}  // namespace mesher::render
