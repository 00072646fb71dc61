#include "engine/io/weld.h"

#include <tbb/parallel_sort.h>

#include <cstring>

#include "engine/core/parallel.h"
#include "engine/mesh/ids.h"

namespace mesher::io {
namespace {

constexpr std::size_t kWeldGrain = std::size_t{1} << 14;

struct Entry {
  std::uint32_t hash;
  std::uint32_t item;
};

std::uint32_t hash_of(const std::uint32_t* item, std::size_t words) {
  std::uint64_t hash = 0x9E3779B97F4A7C15U;
  for (std::size_t i = 0; i < words; ++i) {
    hash = (hash ^ item[i]) * 0xD6E8FEB86659FD93U;
    hash ^= hash >> 32;
  }
  return static_cast<std::uint32_t>(hash);
}

}  // namespace

Weld weld(const std::uint32_t* items, std::size_t words, std::size_t count) {
  const auto at = [&](std::uint32_t i) { return items + i * words; };
  Array<Entry> entries(count);
  parallel_for(count, kWeldGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      entries[i] = {hash_of(items + i * words, words), static_cast<std::uint32_t>(i)};
    }
  });
  // The hash only speeds up most comparisons. Equal hashes are resolved by comparing the items.
  tbb::parallel_sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
    if (a.hash != b.hash) return a.hash < b.hash;
    const int order = std::memcmp(at(a.item), at(b.item), words * sizeof(std::uint32_t));
    return order != 0 ? order < 0 : a.item < b.item;
  });

  Weld result;
  result.index.resize(count);
  std::uint32_t lowest = kNone;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_same = i > 0 && entries[i].hash == entries[i - 1].hash &&
                         std::memcmp(at(entries[i].item), at(entries[i - 1].item),
                                     words * sizeof(std::uint32_t)) == 0;
    if (!is_same) lowest = entries[i].item;
    result.index[entries[i].item] = lowest;
  }
  // The lowest of equal items comes first, so its number is known when the others need it.
  for (std::size_t i = 0; i < count; ++i) {
    if (result.index[i] == i) {
      result.index[i] = static_cast<std::uint32_t>(result.first.size());
      result.first.push_back(static_cast<std::uint32_t>(i));
    } else {
      result.index[i] = result.index[result.index[i]];
    }
  }
  return result;
}

Weld weld_positions(const Array<glm::vec3>& positions) {
  Array<glm::vec3> keys(positions.size());
  parallel_for(positions.size(), kWeldGrain, [&](IndexRange range) {
    // Adding 0 turns -0 into 0 and changes nothing else.
    for (std::size_t i = range.begin; i < range.end; ++i)
      keys[i] = positions[i] + 0.0F;
  });
  return weld(reinterpret_cast<const std::uint32_t*>(keys.data()), 3, keys.size());
}

}  // namespace mesher::io
