#include "engine/mesh/array_delta.h"

#include <cstring>

#include "engine/core/parallel.h"

namespace mesher {
namespace {

constexpr std::size_t kDeltaChunk = std::size_t{1} << 16U;
/// Times of comparing two states, and of copying what differs of each.
constexpr double kDeltaWeights[] = {0.4, 0.3, 0.3};
// Bytes between two checks for a cancellation.
constexpr std::size_t kCopyChunk = std::size_t{1} << 22U;
// Elements are compared one by one only in blocks of this size that differ.
constexpr std::size_t kBlock = 64;

/// Two arrays of the same number of elements, side by side.
struct Pair {
  const std::byte* before;
  const std::byte* after;
  std::size_t element_bytes;

  bool is_same(std::size_t first, std::size_t count) const {
    return std::memcmp(before + first * element_bytes, after + first * element_bytes,
                       count * element_bytes) == 0;
  }
  // A memcmp call would cost more than comparing the few words of one element.
  bool is_same_element(std::size_t i) const {
    if (element_bytes % sizeof(std::uint32_t) != 0) return is_same(i, 1);
    for (std::size_t at = i * element_bytes; at < (i + 1) * element_bytes; at += 4) {
      std::uint32_t a = 0;
      std::uint32_t b = 0;
      std::memcpy(&a, before + at, sizeof a);
      std::memcpy(&b, after + at, sizeof b);
      if (a != b) return false;
    }
    return true;
  }
};

void append(std::vector<ChangedRange>& ranges, ChangedRange range) {
  if (!ranges.empty() && ranges.back().end == range.begin) {
    ranges.back().end = range.end;
  } else {
    ranges.push_back(range);
  }
}

std::vector<ChangedRange> differing(const Pair& pair, IndexRange chunk) {
  std::vector<ChangedRange> ranges;
  for (std::size_t begin = chunk.begin; begin < chunk.end; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, chunk.end);
    if (pair.is_same(begin, end - begin)) continue;
    for (std::size_t i = begin; i < end; ++i) {
      if (pair.is_same_element(i)) continue;
      const auto element = static_cast<std::uint32_t>(i);
      append(ranges, {element, element + 1});
    }
  }
  return ranges;
}

}  // namespace

ArrayDelta::ArrayDelta(std::span<const std::byte> before, std::span<const std::byte> after,
                       std::size_t element_bytes, Progress* progress)
    : element_bytes_(element_bytes),
      old_count_(before.size() / element_bytes),
      new_count_(after.size() / element_bytes) {
  if (before.data() == after.data() && before.size() == after.size()) return;  // the same array
  const Pair pair{before.data(), after.data(), element_bytes};
  std::vector<std::vector<ChangedRange>> parts(chunk_count(common(), kDeltaChunk));
  Stages stages(progress, kDeltaWeights);
  stages.next();
  parallel_chunks(common(), kDeltaChunk, progress,
                  [&](std::size_t i, IndexRange chunk) { parts[i] = differing(pair, chunk); });
  for (const std::vector<ChangedRange>& part : parts) {
    for (const ChangedRange range : part)
      append(ranges_, range);
  }
  ranges_.shrink_to_fit();
  stages.next();
  before_ = gather(before, progress);
  stages.next();
  after_ = gather(after, progress);
}

void ArrayDelta::add_element(std::uint32_t index, std::span<const std::byte> before,
                             std::span<const std::byte> after) {
  MESHER_ASSERT(ranges_.empty() || index >= ranges_.back().end);
  if (std::memcmp(before.data(), after.data(), element_bytes_) == 0) return;
  append(ranges_, {index, index + 1});
  before_.insert(before_.end(), before.begin(), before.end());
  after_.insert(after_.end(), after.begin(), after.end());
}

std::size_t ArrayDelta::memory_bytes() const {
  return ranges_.capacity() * sizeof(ChangedRange) + before_.capacity() + after_.capacity();
}

Array<std::byte> ArrayDelta::gather(std::span<const std::byte> bytes, Progress* progress) const {
  const std::size_t tail = common() * element_bytes_;
  std::size_t size = bytes.size() - tail;
  for (const ChangedRange range : ranges_)
    size += (range.end - range.begin) * element_bytes_;
  Array<std::byte> content(size);
  auto to = content.begin();
  const auto append = [&](std::span<const std::byte> part) {
    ordered_chunks(part.size(), kCopyChunk, progress, [&](IndexRange range) {
      to = std::copy(part.begin() + range.begin, part.begin() + range.end, to);
    });
  };
  for (const ChangedRange range : ranges_) {
    append(bytes.subspan(range.begin * element_bytes_, (range.end - range.begin) * element_bytes_));
  }
  append(bytes.subspan(tail));
  return content;
}

void ArrayDelta::write_bytes(std::span<std::byte> bytes, Direction direction) const {
  const Array<std::byte>& content = direction == Direction::forward ? after_ : before_;
  auto from = content.begin();
  for (const ChangedRange range : ranges_) {
    const auto size = (range.end - range.begin) * element_bytes_;
    std::copy(from, from + size, bytes.begin() + range.begin * element_bytes_);
    from += size;
  }
  std::copy(from, content.end(), bytes.begin() + common() * element_bytes_);
}

}  // namespace mesher
