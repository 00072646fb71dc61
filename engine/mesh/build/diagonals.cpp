#include "engine/mesh/build/diagonals.h"

#include <algorithm>

namespace mesher {
namespace {

struct Side {
  std::uint32_t polygon;
  std::uint32_t h;
  friend auto operator<=>(const Side&, const Side&) = default;
};

}  // namespace

std::vector<Diagonal> crowded_diagonals(const Array<Vertex>& origin, const EdgeMatching& matching,
                                        const Array<std::uint32_t>& polygon_of) {
  std::vector<Diagonal> diagonals;
  if (polygon_of.empty()) return diagonals;
  std::vector<bool> is_taken(polygon_of.size(), false);
  std::vector<Side> sides;
  for (std::size_t i = 0; i < matching.crowd_count(); ++i) {
    sides.clear();
    for (const std::uint32_t h : matching.crowd(i))
      sides.push_back({polygon_of[h / 3], h});
    std::sort(sides.begin(), sides.end());
    std::size_t left = sides.size();
    for (std::size_t k = 1; k < sides.size() && left > 2; ++k) {
      const std::uint32_t a = sides[k - 1].h;
      const std::uint32_t b = sides[k].h;
      if (sides[k].polygon != sides[k - 1].polygon || is_taken[a / 3] || is_taken[b / 3]) continue;
      if (origin[Mesh::prev(Halfedge(a)).index()] == origin[Mesh::prev(Halfedge(b)).index()])
        continue;
      is_taken[a / 3] = is_taken[b / 3] = true;
      diagonals.push_back({Halfedge(a), Halfedge(b)});
      left -= 2;
      ++k;
    }
  }
  return diagonals;
}

}  // namespace mesher
