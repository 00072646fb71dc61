#include "engine/render/upload.h"

#include <vector>

namespace mesher::render {

void upload_whole(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                  VkBufferUsageFlags usage, UploadStats& stats) {
  if (buffer.size() != source.size()) {
    buffer = gpu::Buffer(device, source.size(), usage, gpu::MemoryIntent::fixed);
  }
  if (source.empty()) return;
  gpu::upload(device, buffer, source);
  stats.uploaded_bytes += source.size();
  ++stats.ranges;
}

void upload_ranges(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                   std::span<const ChangedRange> ranges, std::size_t element_bytes,
                   UploadStats& stats) {
  std::vector<gpu::ByteRange> bytes;
  bytes.reserve(ranges.size());
  for (const ChangedRange range : ranges) {
    bytes.push_back({range.begin * element_bytes, range.end * element_bytes});
    stats.uploaded_bytes += bytes.back().size();
  }
  stats.ranges += static_cast<std::uint32_t>(ranges.size());
  gpu::upload(device, buffer, source, bytes);
}

std::uint32_t worthwhile_gap(std::size_t element_bytes) {
  constexpr std::size_t kBytes = 64;  // a cache line
  return static_cast<std::uint32_t>(kBytes / element_bytes);
}

}  // namespace mesher::render
