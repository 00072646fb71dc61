#include "engine/simplify/checkpoint.h"

#include <algorithm>

#include "engine/mesh/circulators.h"

namespace mesher::simplify {

Checkpoint::Checkpoint(const Mesh& mesh, std::span<const Vertex> live) {
  vertices_.reserve(live.size());
  for (const Vertex v : live) {
    vertices_.push_back({v, mesh.outgoing(v), mesh.position(v), mesh.sharpness(v)});
    for (const Halfedge h : halfedges_around(mesh, v)) {
      // Copy each face once, at its lowest vertex.
      if (v < std::min(mesh.target(h), mesh.origin(Mesh::prev(h)))) copy_face(mesh, Mesh::face(h));
    }
  }
}

void Checkpoint::copy_face(const Mesh& mesh, Face f) {
  FaceCopy copy{.f = f, .origin = {}, .twin = {}, .sharpness = {}};
  for (std::uint32_t c = 0; c < 3; ++c) {
    const Halfedge h = Mesh::halfedge(f, c);
    copy.origin[c] = mesh.origin(h);
    copy.twin[c] = mesh.twin(h);
    copy.sharpness[c] = mesh.sharpness(h);
  }
  faces_.push_back(copy);
}

void Checkpoint::restore(Mesh& mesh, Array<Vertex>& live) const {
  const MeshArrays::InPlace arrays = MeshArrays::open(mesh);
  live.clear();
  for (const VertexCopy& copy : vertices_) {
    const std::uint32_t v = copy.v.index();
    arrays.outgoing[v] = copy.outgoing;
    arrays.position[v] = copy.position;
    if (!arrays.vertex_sharpness.empty()) arrays.vertex_sharpness[v] = copy.sharpness;
    live.push_back(copy.v);
  }
  for (const FaceCopy& copy : faces_) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t h = Mesh::halfedge(copy.f, c).index();
      arrays.origin[h] = copy.origin[c];
      arrays.twin[h] = copy.twin[c];
      arrays.sharpness[h] = copy.sharpness[c];
    }
  }
}

}  // namespace mesher::simplify
