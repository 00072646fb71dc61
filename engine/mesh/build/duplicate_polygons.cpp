#include "engine/mesh/build/duplicate_polygons.h"

#include <algorithm>
#include <span>

namespace mesher {
namespace {

std::span<const std::uint32_t> corners_of(const Soup& soup, std::uint32_t face) {
  return {soup.corners.data() + soup.face_start[face],
          soup.face_start[face + 1] - soup.face_start[face]};
}

/// Returns the corners from the lowest one on, toward the lower of its neighbors: the same for
/// every start corner and direction of one outline. (An outline that visits its lowest corner twice
/// may have several such forms, so two copies of it may count as different.)
std::vector<std::uint32_t> canonical(std::span<const std::uint32_t> corners) {
  std::vector<std::uint32_t> result(corners.begin(), corners.end());
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  if (result.back() < result[1]) std::reverse(result.begin() + 1, result.end());
  return result;
}

/// A sum over corners, so that the hash is the same for every start corner and direction.
std::uint64_t order_free_hash(std::span<const std::uint32_t> corners) {
  std::uint64_t hash = corners.size();
  for (const std::uint32_t v : corners) {
    std::uint64_t x = v + 0x9E3779B97F4A7C15U;
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
    hash += x ^ (x >> 31U);
  }
  return hash;
}

}  // namespace

std::vector<std::uint32_t> duplicate_polygons(const Soup& soup) {
  struct Key {
    std::uint64_t hash;
    std::uint32_t face;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  for (std::uint32_t f = 0; f < soup.face_count(); ++f) {
    const auto corners = corners_of(soup, f);
    if (corners.size() > 3) keys.push_back({order_free_hash(corners), f});
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> duplicates;
  for (std::size_t begin = 0; begin < keys.size();) {
    std::size_t end = begin + 1;
    while (end < keys.size() && keys[end].hash == keys[begin].hash)
      ++end;
    // Faces with equal hashes have the same corners up to order. Sorting makes equal faces
    // adjacent.
    std::vector<std::pair<std::vector<std::uint32_t>, std::uint32_t>> group;
    for (std::size_t i = begin; end - begin > 1 && i < end; ++i) {
      group.emplace_back(canonical(corners_of(soup, keys[i].face)), keys[i].face);
    }
    std::sort(group.begin(), group.end());
    for (std::size_t i = 1; i < group.size(); ++i) {
      if (group[i].first == group[i - 1].first) duplicates.push_back(group[i].second);
    }
    begin = end;
  }
  std::sort(duplicates.begin(), duplicates.end());
  return duplicates;
}

}  // namespace mesher
