#include "engine/mesh/build/duplicate_polygons.h"

#include <algorithm>
#include <span>

namespace mesher {
namespace {

std::span<const std::uint32_t> corners_of(const Soup& soup, std::uint32_t face) {
  return {soup.corners.data() + soup.face_start[face],
          soup.face_start[face + 1] - soup.face_start[face]};
}

struct Outline {
  std::vector<std::uint32_t> corners;
  CoincidentFace face;
  bool operator<(const Outline& other) const {
    return corners != other.corners ? corners < other.corners : face.face < other.face.face;
  }
};

/// Returns the corners from the lowest one on, toward the lower of its neighbors: the same for
/// every start corner and direction of one outline. (An outline that visits its lowest corner twice
/// may have several such forms, so two copies of it may count as different.)
Outline canonical(const Soup& soup, std::uint32_t face) {
  const std::span<const std::uint32_t> corners = corners_of(soup, face);
  std::vector<std::uint32_t> result(corners.begin(), corners.end());
  std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
  const bool is_reversed = result.back() < result[1];
  if (is_reversed) std::reverse(result.begin() + 1, result.end());
  const Array<std::uint32_t>& group = soup.attributes.group;
  return {std::move(result), {face, is_reversed, group.empty() ? 0 : group[face]}};
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

CoincidentFaces coincident_polygons(const Soup& soup) {
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
  CoincidentFaces found;
  for (std::size_t begin = 0; begin < keys.size();) {
    std::size_t end = begin + 1;
    while (end < keys.size() && keys[end].hash == keys[begin].hash)
      ++end;
    // Faces with equal hashes have the same corners up to order. Sorting makes equal faces
    // adjacent.
    std::vector<Outline> outlines;
    for (std::size_t i = begin; end - begin > 1 && i < end; ++i)
      outlines.push_back(canonical(soup, keys[i].face));
    std::sort(outlines.begin(), outlines.end());
    for (std::size_t first = 0; first < outlines.size();) {
      std::vector<CoincidentFace> same;
      std::size_t last = first;
      for (; last < outlines.size() && outlines[last].corners == outlines[first].corners; ++last)
        same.push_back(outlines[last].face);
      sort_coincident(same, found);
      first = last;
    }
    begin = end;
  }
  std::sort(found.duplicates.begin(), found.duplicates.end());
  std::sort(found.second_sides.begin(), found.second_sides.end(),
            [](const SecondSide& a, const SecondSide& b) { return a.face < b.face; });
  return found;
}

}  // namespace mesher
