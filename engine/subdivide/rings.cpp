#include "engine/subdivide/rings.h"

namespace mesher::subdivide {

Rings::Rings(const LevelView& base, bool lists_spokes) {
  start_.assign(base.vertex_count() + std::size_t{2}, 0);
  for (const Vertex v : base.origin)
    ++start_[v.index() + 2];
  for (std::size_t v = 2; v < start_.size(); ++v)
    start_[v] += start_[v - 1];
  if (lists_spokes) {
    spokes_.resize(base.origin.size());
    // Advances start_[v + 1] from the start of v to the start of v + 1.
    for (std::uint32_t h = 0; h < base.origin.size(); ++h)
      spokes_[start_[base.origin[h].index() + 1]++] = Halfedge(h);
    start_.pop_back();
  } else {
    start_.erase(start_.begin());
  }
}

}  // namespace mesher::subdivide
