#include "engine/mesh/collapse.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "engine/mesh/circulators.h"
#include "engine/mesh/mesh_editor.h"

namespace mesher {
namespace {

Vertex apex(const Mesh& mesh, Halfedge h) {
  return mesh.origin(Mesh::prev(h));
}

bool is_apex(const Mesh& mesh, Halfedge h, Vertex v) {
  const Halfedge t = mesh.twin(h);
  return v == apex(mesh, h) || (t.is_valid() && v == apex(mesh, t));
}

/// Returns a common neighbor of both ends that is not opposite the edge, or none.
Vertex stray_common_neighbor(const Mesh& mesh, Halfedge h) {
  std::vector<Vertex> ring;
  for (const Vertex n : vertices_around(mesh, mesh.target(h)))
    ring.push_back(n);
  std::sort(ring.begin(), ring.end());
  for (const Vertex n : vertices_around(mesh, mesh.origin(h))) {
    if (!is_apex(mesh, h, n) && std::binary_search(ring.begin(), ring.end(), n)) return n;
  }
  return {};
}

/// Returns a half-edge out of target(h) that survives the removal of the edge's faces.
Halfedge surviving_spoke(const Mesh& mesh, Halfedge h) {
  const Halfedge beyond_prev = mesh.twin(Mesh::prev(h));  // starts at origin(h)
  if (beyond_prev.is_valid()) return beyond_prev;
  return Mesh::next(mesh.twin(Mesh::next(h)));
}

bool is_joined_by_one_side_or_none(const Mesh& mesh, Halfedge h) {
  return mesh.is_boundary(Mesh::next(h)) && mesh.is_boundary(Mesh::prev(h));
}

}  // namespace

std::string_view describe(CollapseVerdict verdict) {
  switch (verdict) {
    case CollapseVerdict::link_condition:
      return "link condition";
    case CollapseVerdict::pinches_boundary:
      return "pinches the boundary";
    case CollapseVerdict::leaves_vertex:
      return "leaves an isolated vertex";
    case CollapseVerdict::tetrahedron:
      return "part of a tetrahedron";
    case CollapseVerdict::legal:
      break;
  }
  return "legal";
}

CollapseCheck check_collapse(const Mesh& mesh, Halfedge h) {
  const Halfedge t = mesh.twin(h);
  const Vertex a = mesh.origin(h);
  const Vertex b = mesh.target(h);
  if (t.is_valid() && mesh.is_boundary(a) && mesh.is_boundary(b)) {
    return {CollapseVerdict::pinches_boundary, a};
  }
  for (const Halfedge side : {h, t}) {
    if (side.is_valid() && is_joined_by_one_side_or_none(mesh, side)) {
      return {CollapseVerdict::leaves_vertex, apex(mesh, side)};
    }
  }
  const Vertex stray = stray_common_neighbor(mesh, h);
  if (stray.is_valid()) return {CollapseVerdict::link_condition, stray};
  // Each ring consists of the two apexes and the other end: a closed tetrahedron.
  if (t.is_valid() && !mesh.is_boundary(a) && !mesh.is_boundary(b) && mesh.valence(a) == 3 &&
      mesh.valence(b) == 3) {
    return {CollapseVerdict::tetrahedron, a};
  }
  return {};
}

CollapseResult collapse(Mesh& mesh, Halfedge h, const glm::vec3& p) {
  MESHER_ASSERT(check_collapse(mesh, h).is_legal());
  MeshEditor edit(mesh);
  const Halfedge t = mesh.twin(h);
  const Vertex removed = mesh.origin(h);
  Vertex kept = mesh.target(h);
  const Halfedge spoke = surviving_spoke(mesh, h);
  edit.move_fan(removed, kept);
  edit.join_sharpness(h);
  edit.close_edge(h);
  edit.merge_bow_tie_copies(removed, kept, p);
  mesh.set_position(kept, p);
  edit.take_over(removed, kept);
  edit.start_fan_at_boundary(kept, spoke);

  CollapseResult result;
  result.vertex_move = edit.remove_vertex(removed);
  if (result.vertex_move.from == kept.index()) kept = removed;
  result.kept = kept;
  // Remove the higher face first: otherwise it could be the face that moves into the other's hole.
  std::array<std::uint32_t, 2> faces{Mesh::face(h).index(),
                                     t.is_valid() ? Mesh::face(t).index() : kNone};
  std::sort(faces.begin(), faces.end(), std::greater<>());
  for (const std::uint32_t f : faces) {
    if (f == kNone) continue;
    result.face_moves[result.removed_faces++] = edit.remove_face(Face(f));
  }
  return result;
}

}  // namespace mesher
