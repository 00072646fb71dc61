#include "engine/render/upload.h"

#include <vector>

namespace mesher::render {
namespace {

/// Elements between two ranges so near each other that one copy of both is cheaper than two.
std::uint32_t worthwhile_gap(std::size_t element_bytes) {
  constexpr std::size_t kBytes = 64;  // a cache line
  return static_cast<std::uint32_t>(kBytes / element_bytes);
}

}  // namespace

void upload_whole(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                  VkBufferUsageFlags usage, UploadStats& stats) {
  if (buffer.size() < source.size()) {
    buffer = gpu::Buffer(device, source.size(), usage, gpu::MemoryIntent::fixed);
  }
  if (source.empty()) return;
  gpu::upload(device, buffer, source);
  stats.uploaded_bytes += source.size();
  ++stats.ranges;
}

void upload_changes(gpu::Device& device, gpu::Buffer& buffer, std::span<const std::byte> source,
                    const ChangedElements& changed, VkBufferUsageFlags usage, UploadStats& stats) {
  if (changed.log.is_whole(changed.array) || buffer.size() < source.size()) {
    return upload_whole(device, buffer, source, usage, stats);
  }
  const auto count = static_cast<std::uint32_t>(source.size() / changed.element_bytes);
  std::vector<gpu::ByteRange> bytes;
  for (const ChangedRange range :
       changed.log.merged(changed.array, worthwhile_gap(changed.element_bytes), count)) {
    bytes.push_back({range.begin * changed.element_bytes, range.end * changed.element_bytes});
    stats.uploaded_bytes += bytes.back().size();
  }
  stats.ranges += static_cast<std::uint32_t>(bytes.size());
  gpu::upload(device, buffer, source, bytes);
}

}  // namespace mesher::render
