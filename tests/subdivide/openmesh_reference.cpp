#include "tests/subdivide/openmesh_reference.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#include <algorithm>
#include <set>
#include <stdexcept>

namespace mesher::test {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using PeerMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

PeerMesh peer_of(const PlainMesh& mesh) {
  PeerMesh peer;
  for (const Point& p : mesh.positions)
    peer.add_vertex({p.x, p.y, p.z});
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return OpenMesh::VertexHandle(int(t[k])); };
    peer.add_face(corner(0), corner(1), corner(2));
  }
  return peer;
}

/// Rotates the triangle so that its lowest corner comes first.
Triangle canonical(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

PlainMesh openmesh_butterfly(const PlainMesh& mesh) {
  PeerMesh peer = peer_of(mesh);
  const Adjacency near = adjacency(mesh);
  const auto old_vertices = static_cast<std::uint32_t>(mesh.positions.size());
  // OpenMesh splits its edges in order, and each split makes one vertex.
  std::vector<std::uint32_t> ours;
  for (std::uint32_t v = 0; v < old_vertices; ++v)
    ours.push_back(v);
  for (const auto e : peer.edges()) {
    const auto h = peer.halfedge_handle(e, 0);
    const auto a = static_cast<std::uint32_t>(peer.from_vertex_handle(h).idx());
    const auto b = static_cast<std::uint32_t>(peer.to_vertex_handle(h).idx());
    ours.push_back(old_vertices + near.edge_index.at(pair_of(a, b)));
  }
  OpenMesh::Subdivider::Uniform::ModifiedButterflyT<PeerMesh> subdivider;
  subdivider(peer, 1);
  PlainMesh fine;
  fine.positions.resize(peer.n_vertices());
  fine.vertex_sharpness.assign(peer.n_vertices(), 0.0);
  for (const auto v : peer.vertices()) {
    const auto& p = peer.point(v);
    fine.positions[ours[std::size_t(v.idx())]] = {p[0], p[1], p[2]};
  }
  std::set<Triangle> theirs;
  for (const auto f : peer.faces()) {
    Triangle t{};
    std::size_t k = 0;
    for (const auto v : peer.fv_range(f))
      t[k++] = ours[std::size_t(v.idx())];
    theirs.insert(canonical(t));
  }
  // OpenMesh has its own order of faces. Compare the faces as a set, then return them in our order.
  fine.triangles = split_triangles(mesh, near);
  for (const Triangle& t : fine.triangles) {
    if (!theirs.contains(canonical(t))) throw std::runtime_error("OpenMesh has other triangles");
  }
  if (theirs.size() != fine.triangles.size())
    throw std::runtime_error("OpenMesh has more triangles");
  return fine;
}

}  // namespace mesher::test
