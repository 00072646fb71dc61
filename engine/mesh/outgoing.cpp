#include "engine/mesh/outgoing.h"

namespace mesher {

void fill_outgoing(MeshArrays& arrays) {
  arrays.outgoing.assign(arrays.position.size(), Halfedge{});
  const auto halfedges = static_cast<std::uint32_t>(arrays.origin.size());
  for (std::uint32_t h = halfedges; h-- > 0;) {
    Halfedge& outgoing = arrays.outgoing[arrays.origin[h].index()];
    const bool keeps_boundary = outgoing.is_valid() && !arrays.twin[outgoing.index()].is_valid() &&
                                arrays.twin[h].is_valid();
    if (!keeps_boundary) outgoing = Halfedge(h);
  }
}

}  // namespace mesher
