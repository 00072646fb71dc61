#include "engine/simplify/simplify.h"

#include <numeric>

#include "engine/mesh/collapse.h"

namespace mesher {

Simplified simplify(Mesh&& mesh, const SimplifyOptions& options) {
  Simplified result;
  SimplifyReport& r = result.report;
  r.faces_before = mesh.face_count();
  r.faces_asked = options.target_faces;
  r.vertices_before = mesh.vertex_count();
  result.vertex_source.resize(mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    result.vertex_source[v] = Vertex(v);
  result.face_source.resize(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    result.face_source[f] = Face(f);
  r.reason = StopReason::already_there;
  for (std::uint32_t i = 0; mesh.face_count() > options.target_faces;) {
    const std::uint32_t n = mesh.halfedge_count();
    bool found = false;
    for (std::uint32_t k = 0; k < n; ++k) {
      const Halfedge h((i * 7919U + k) % n);
      if (!check_collapse(mesh, h).is_legal()) continue;
      const glm::vec3 p = 0.5F * (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h)));
      const CollapseResult c = collapse(mesh, h, p);
      if (c.vertex_move.from != kNone) {
        result.vertex_source[c.vertex_move.to] = result.vertex_source[c.vertex_move.from];
      }
      result.vertex_source.pop_back();
      for (std::uint32_t m = 0; m < c.removed_faces; ++m) {
        const CollapseResult::Move move = c.face_moves[m];
        if (move.from != kNone) result.face_source[move.to] = result.face_source[move.from];
        result.face_source.pop_back();
      }
      found = true;
      ++i;
      ++r.collapses;
      break;
    }
    r.reason = found ? StopReason::target_reached : StopReason::no_legal_collapse;
    if (!found) break;
  }
  r.faces_reached = mesh.face_count();
  r.vertices_reached = mesh.vertex_count();
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace mesher
