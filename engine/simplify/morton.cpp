#include "engine/simplify/morton.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "engine/core/array.h"
#include "engine/core/parallel.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kMortonGrain = 1U << 14;
constexpr std::uint32_t kDigitBits = 11;
constexpr std::uint32_t kDigits = 1U << kDigitBits;

struct Item {
  std::uint32_t key;
  Vertex vertex;
};

/// Spreads the lowest 10 bits, with two zeros between neighbors.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16U) & 0x030000FFU;
  x = (x | x << 8U) & 0x0300F00FU;
  x = (x | x << 4U) & 0x030C30C3U;
  x = (x | x << 2U) & 0x09249249U;
  return x;
}

struct Extent {
  glm::vec3 min;
  glm::vec3 max;
};

Extent extent(std::span<const glm::vec3> positions, std::span<const Vertex> vertices) {
  std::vector<Extent> parts(chunk_count(vertices.size(), kMortonGrain));
  parallel_chunks(vertices.size(), kMortonGrain, [&](std::size_t chunk, IndexRange range) {
    Extent part{positions[vertices[range.begin].index()], positions[vertices[range.begin].index()]};
    for (std::size_t i = range.begin; i < range.end; ++i) {
      part.min = glm::min(part.min, positions[vertices[i].index()]);
      part.max = glm::max(part.max, positions[vertices[i].index()]);
    }
    parts[chunk] = part;
  });
  Extent all = parts.front();
  for (const Extent& part : parts)
    all = {glm::min(all.min, part.min), glm::max(all.max, part.max)};
  return all;
}

/// One pass of a counting sort, by one digit of the key.
void sort_by_digit(const Array<Item>& from, Array<Item>& to, std::uint32_t shift) {
  std::array<std::uint32_t, kDigits> start{};
  const auto digit = [&](const Item& item) { return item.key >> shift & (kDigits - 1); };
  for (const Item& item : from)
    ++start[digit(item)];
  std::uint32_t before = 0;
  for (std::uint32_t& s : start)
    before += std::exchange(s, before);
  for (const Item& item : from)
    to[start[digit(item)]++] = item;
}

}  // namespace

Array<Vertex> morton_order(std::span<const glm::vec3> positions, std::span<const Vertex> vertices,
                           const MortonGrid& grid, const Progress* progress) {
  if (vertices.empty()) return {};
  const Extent box = extent(positions, vertices);
  const glm::vec3 size = box.max - box.min;
  const float longest = std::max({size.x, size.y, size.z});
  const auto cells = static_cast<float>(1U << grid.bits);
  // Half of the grid is reserved for the shift.
  const float scale = longest > 0.0F ? (0.5F * cells - 1.0F) / longest : 0.0F;
  const float shift = grid.shift * 0.5F * cells;
  const auto cell = [&](float x, float low) {
    const float at = (x - low) * scale + shift;
    // A model whose size is beyond the range of float gives NaN or infinity.
    return at < cells ? spread(static_cast<std::uint32_t>(at)) : 0U;
  };
  Array<Item> items(vertices.size());
  Array<Item> sorted(vertices.size());
  parallel_for(vertices.size(), kMortonGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const glm::vec3& p = positions[vertices[i].index()];
      items[i] = {cell(p.x, box.min.x) | cell(p.y, box.min.y) << 1U | cell(p.z, box.min.z) << 2U,
                  vertices[i]};
    }
  });
  for (std::uint32_t bits = 0; bits < 3 * grid.bits; bits += kDigitBits) {
    check_cancelled(progress);
    sort_by_digit(items, sorted, bits);
    std::swap(items, sorted);
  }
  check_cancelled(progress);
  Array<Vertex> order(vertices.size());
  for (std::size_t i = 0; i < items.size(); ++i)
    order[i] = items[i].vertex;
  return order;
}

}  // namespace mesher::simplify
