#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "engine/mesh/build/soup.h"

namespace mesher::bench {

using PeerMesh = OpenMesh::TriMesh_ArrayKernelT<>;

/// Returns an OpenMesh mesh of the same triangles. Pre: the triangles are manifold.
inline PeerMesh make_mesh(const Soup& soup) {
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

}  // namespace mesher::bench
