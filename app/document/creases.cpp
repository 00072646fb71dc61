#include "app/document/creases.h"

#include <algorithm>
#include <iterator>

namespace mesher::app {

std::vector<Edge> CreaseMode::selected_inner_edges(const Mesh& mesh) const {
  std::vector<Edge> edges;
  std::ranges::copy_if(selected, std::back_inserter(edges),
                       [&](Edge e) { return !mesh.is_boundary(e); });
  return edges;
}

SelectedSharpness selected_sharpness(const Mesh& mesh, const CreaseMode& creases) {
  SelectedSharpness result;
  for (const Edge e : creases.selected_inner_edges(mesh)) {
    const float sharpness = mesh.sharpness(Mesh::halfedge(e));
    if (result.edges == 0) result.least = result.most = sharpness;
    result.least = std::min(result.least, sharpness);
    result.most = std::max(result.most, sharpness);
    ++result.edges;
  }
  return result;
}

}  // namespace mesher::app
