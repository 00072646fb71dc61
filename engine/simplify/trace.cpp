#include "engine/simplify/trace.h"

#include <utility>

namespace mesher::simplify {
namespace {

KeptIds find_kept(const Surface& surface) {
  const Mesh& mesh = surface.mesh();
  KeptIds kept;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_isolated(Vertex(v))) kept.vertices.emplace_back(v);
  }
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    if (!surface.is_removed(Face(f))) kept.faces.emplace_back(f);
  }
  return kept;
}

}  // namespace

Array<std::uint32_t> find_survivors(const Surface& surface) {
  const std::uint32_t n = surface.mesh().vertex_count();
  Array<std::uint32_t> into(n);
  for (std::uint32_t v = 0; v < n; ++v) {
    const VertexState& state = surface.state(Vertex(v));
    into[v] = state.region == VertexState::kGone ? state.merged_into().index() : v;
  }
  for (std::uint32_t v = 0; v < n; ++v) {
    std::uint32_t last = v;
    while (into[last] != last)
      last = into[last];
    // Path compression.
    for (std::uint32_t at = v; at != last;)
      at = std::exchange(into[at], last);
  }
  return into;
}

void trace(const Surface& surface, Trace& trace) {
  const Mesh& mesh = surface.mesh();
  KeptIds kept = find_kept(surface);
  trace.after = compact(mesh, kept);
  const Array<std::uint32_t> survivor = find_survivors(surface);
  Array<Face> new_id;
  new_id.assign(mesh.face_count(), Face(0));
  for (std::uint32_t f = 0; f < kept.faces.size(); ++f)
    new_id[kept.faces[f].index()] = Face(f);
  trace.near_before.resize(mesh.face_count());
  for (std::uint32_t i = 0; i < mesh.face_count(); ++i) {
    Face near(i);
    if (surface.is_removed(near)) {
      const Vertex corner = trace.before.origin(Mesh::halfedge(Face(i)));
      const Halfedge h = mesh.outgoing(Vertex(survivor[corner.index()]));
      if (h.is_valid()) near = Mesh::face(h);
    }
    trace.near_before[i] = new_id[near.index()];
  }
  trace.vertex_before = std::move(kept.vertices);
  trace.near_after = std::move(kept.faces);
}

}  // namespace mesher::simplify
