#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "tests/bench/contenders.h"

namespace mesher::bench {
namespace {

using PeerMesh = OpenMesh::TriMesh_ArrayKernelT<>;

PeerMesh make_mesh(const Soup& soup) {
  PeerMesh mesh;
  mesh.reserve(soup.positions.size(), soup.corners.size() / 2, soup.face_count());
  for (const glm::vec3& p : soup.positions)
    mesh.add_vertex({p.x, p.y, p.z});
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    const auto corner = [&](std::size_t i) {
      return OpenMesh::VertexHandle(static_cast<int>(soup.corners[c + i]));
    };
    mesh.add_face(corner(0), corner(1), corner(2));
  }
  return mesh;
}

/// Pre: no garbage.
Soup make_arrays(const PeerMesh& mesh) {
  Soup soup;
  soup.positions.reserve(mesh.n_vertices());
  soup.corners.reserve(3 * mesh.n_faces());
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    soup.positions.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto f : mesh.faces()) {
    for (const auto v : mesh.fv_range(f))
      soup.corners.push_back(static_cast<std::uint32_t>(v.idx()));
  }
  return soup;
}

}  // namespace

Soup simplify_openmesh(Soup&& soup, std::uint32_t target_faces) {
  PeerMesh mesh = make_mesh(soup);
  OpenMesh::Decimater::DecimaterT<PeerMesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<PeerMesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, target_faces);
  mesh.garbage_collection();
  return make_arrays(mesh);
}

}  // namespace mesher::bench
