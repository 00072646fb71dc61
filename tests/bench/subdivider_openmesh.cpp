// OpenMesh needs this header but does not include it.
#include <cstddef>

#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include "tests/bench/openmesh_mesh.h"
#include "tests/bench/subdividers.h"

namespace mesher::bench {
SubdivisionOutcome subdivide_openmesh(SubdivisionWork&& work) {
  PeerMesh mesh = make_mesh(work.soup);
  OpenMesh::Subdivider::Uniform::LoopT<PeerMesh> subdivider;
  subdivider(mesh, work.options.levels);
  subdivide::IndexedTriangles result;
  result.position.resize(mesh.n_vertices());
  result.index.resize(3 * mesh.n_faces());
  glm::vec3* position = result.position.data();
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    *position++ = {p[0], p[1], p[2]};
  }
  Vertex* corner = result.index.data();
  for (const auto f : mesh.faces()) {
    for (const auto v : mesh.fv_range(f))
      *corner++ = Vertex(static_cast<std::uint32_t>(v.idx()));
  }
  return {.triangles = std::move(result)};
}

}  // namespace mesher::bench
