#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "tests/bench/contenders.h"
#include "tests/bench/openmesh_mesh.h"

namespace mesher::bench {
namespace {

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
