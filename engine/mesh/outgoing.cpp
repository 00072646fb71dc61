#include "engine/mesh/outgoing.h"

#include "engine/core/parallel.h"

namespace mesher {

void fill_outgoing(MeshArrays& arrays, Progress* progress) {
  constexpr std::size_t kBetweenReports = std::size_t{1} << 18;
  arrays.outgoing.assign(arrays.position.size(), Halfedge{});
  const std::size_t halfedges = arrays.origin.size();
  // The lowest half-edge is written last. The boundary is a pass of its own: looking up the twin of
  // the half-edge found before would miss the cache at every step in polygon soup.
  Stages stages(progress, {1.0, 1.0});
  const auto visit_backwards = [&](const auto& visit) {
    stages.next();
    ordered_chunks(halfedges, kBetweenReports, progress, [&](IndexRange done) {
      const auto last = static_cast<std::uint32_t>(halfedges - done.end);
      for (auto h = static_cast<std::uint32_t>(halfedges - done.begin); h-- > last;)
        visit(h);
    });
  };
  visit_backwards(
      [&](std::uint32_t h) { arrays.outgoing[arrays.origin[h].index()] = Halfedge(h); });
  visit_backwards([&](std::uint32_t h) {
    if (!arrays.twin[h].is_valid()) arrays.outgoing[arrays.origin[h].index()] = Halfedge(h);
  });
}

}  // namespace mesher
