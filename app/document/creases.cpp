#include "app/document/creases.h"

#include <algorithm>
#include <iterator>

namespace mesher::app {

std::vector<Edge> CreaseMode::selected_inner_edges(const Mesh& mesh) const {
  return inner_edges(mesh, selected);
}

std::vector<Edge> inner_edges(const Mesh& mesh, std::span<const Edge> edges) {
  std::vector<Edge> inner;
  std::ranges::copy_if(edges, std::back_inserter(inner),
                       [&](Edge e) { return !mesh.is_boundary(e); });
  return inner;
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
