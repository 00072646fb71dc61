#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include "tests/bench/subdividers.h"

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

}  // namespace

SubdivisionOutcome subdivide_openmesh(SubdivisionWork&& work) {
  PeerMesh mesh = make_mesh(work.soup);
  OpenMesh::Subdivider::Uniform::LoopT<PeerMesh> subdivider;
  subdivider(mesh, work.options.levels);
  IndexedTriangles result;
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
