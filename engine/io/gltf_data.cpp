#include "engine/io/gltf_data.h"

#include <tuple>

namespace mesher::io {
namespace {

constexpr std::uint64_t kWord = 4;

std::uint64_t round_up(std::uint64_t offset) {
  return (offset + kWord - 1) / kWord * kWord;
}

}  // namespace

void GltfData::arrange() {
  std::sort(ranges_.begin(), ranges_.end(), [](const Range& a, const Range& b) {
    return std::tuple(a.buffer, a.offset, a.bytes.size()) <
           std::tuple(b.buffer, b.offset, b.bytes.size());
  });
  std::vector<Range> merged;
  for (const Range& range : ranges_) {
    if (!merged.empty() && merged.back().buffer == range.buffer &&
        range.offset <= merged.back().offset + merged.back().bytes.size()) {
      Range& last = merged.back();
      const std::uint64_t end =
          std::max(last.offset + last.bytes.size(), range.offset + range.bytes.size());
      last.bytes = {last.bytes.data(), static_cast<std::size_t>(end - last.offset)};
    } else {
      merged.push_back(range);
    }
  }
  ranges_ = std::move(merged);
  for (const Range& range : ranges_) {
    range_offsets_.push_back(round_up(size_) + range.offset % kWord);
    size_ = range_offsets_.back() + range.bytes.size();
  }
  for (const std::string& piece : pieces_) {
    piece_offsets_.push_back(round_up(size_));
    size_ = piece_offsets_.back() + piece.size();
  }
  size_ = round_up(size_);
}

std::uint64_t GltfData::offset(std::uint64_t buffer, std::uint64_t offset) const {
  const auto after = std::upper_bound(ranges_.begin(), ranges_.end(), std::pair(buffer, offset),
                                      [](const auto& place, const Range& range) {
                                        return place < std::pair(range.buffer, range.offset);
                                      });
  const auto range = static_cast<std::size_t>(after - ranges_.begin()) - 1;
  return range_offsets_[range] + (offset - ranges_[range].offset);
}

}  // namespace mesher::io
