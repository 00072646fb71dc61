#include "engine/mesh/bow_tie.h"

#include <tuple>

namespace mesher {

void normalize(Array<BowTieCopy>& copies) {
  std::ranges::sort(copies, {}, [](const BowTieCopy& c) { return std::tuple(c.first, c.v); });
  std::size_t kept = 0;
  for (std::size_t begin = 0, end = 0; begin < copies.size(); begin = end) {
    const Vertex group = copies[begin].first;
    while (end < copies.size() && copies[end].first == group)
      ++end;
    if (end - begin == 1) continue;
    const Vertex first = copies[begin].v;
    for (std::size_t i = begin; i < end; ++i)
      copies[kept++] = {copies[i].v, first};
  }
  copies.resize(kept);
  std::ranges::sort(copies, {}, &BowTieCopy::v);
}

}  // namespace mesher
