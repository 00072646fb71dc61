#include "engine/mesh/outgoing.h"

#include "engine/core/parallel.h"

namespace mesher {

void fill_outgoing(MeshArrays& arrays, Progress* progress) {
  constexpr std::size_t kBetweenReports = std::size_t{1} << 18;
  arrays.outgoing.assign(arrays.position.size(), Halfedge{});
  const std::size_t halfedges = arrays.origin.size();
  ordered_chunks(halfedges, kBetweenReports, progress, [&](IndexRange done) {
    const auto last = static_cast<std::uint32_t>(halfedges - done.end);
    for (auto h = static_cast<std::uint32_t>(halfedges - done.begin); h-- > last;) {
      Halfedge& outgoing = arrays.outgoing[arrays.origin[h].index()];
      const bool keeps_boundary = outgoing.is_valid() &&
                                  !arrays.twin[outgoing.index()].is_valid() &&
                                  arrays.twin[h].is_valid();
      if (!keeps_boundary) outgoing = Halfedge(h);
    }
  });
}

}  // namespace mesher
