#include "engine/mesh/mesh_editor.h"

#include <algorithm>

#include "engine/mesh/circulators.h"

namespace mesher {

namespace {

/// Removes a face at its edge `h`: the faces beyond its two other sides become neighbors.
void close_face(MeshEditor& edit, Halfedge h) {
  const Mesh& mesh = edit.mesh();
  const Halfedge next = Mesh::next(h);
  const Halfedge prev = Mesh::prev(h);
  const Halfedge beyond_next = mesh.twin(next);
  const Halfedge beyond_prev = mesh.twin(prev);
  if (beyond_next.is_valid()) edit.set_twin(beyond_next, beyond_prev);
  if (beyond_prev.is_valid()) edit.set_twin(beyond_prev, beyond_next);
  // If the apex's sweep started in this face, it now starts beyond it: at a boundary, that
  // half-edge has just lost its twin.
  const Vertex top = mesh.origin(prev);
  if (mesh.outgoing(top) == prev) edit.set_outgoing(top, beyond_next);
}

}  // namespace

void MeshEditor::join_sharpness(Halfedge h) {
  for (const Halfedge side : {h, mesh_.twin(h)}) {
    if (!side.is_valid()) continue;
    const float sharpness =
        std::max(mesh_.sharpness(Mesh::next(side)), mesh_.sharpness(Mesh::prev(side)));
    for (const Halfedge inner : {Mesh::next(side), Mesh::prev(side)}) {
      if (const Halfedge t = mesh_.twin(inner); t.is_valid()) set_sharpness(t, sharpness);
    }
  }
}

void MeshEditor::close_edge(Halfedge h) {
  const Halfedge t = mesh_.twin(h);
  close_face(*this, h);
  if (t.is_valid()) close_face(*this, t);
}

void MeshEditor::take_over(Vertex removed, Vertex kept) {
  if (mesh_.sharpness(removed) > mesh_.sharpness(kept)) {
    mesh_.set_sharpness(kept, mesh_.sharpness(removed));
  }
}

void MeshEditor::move_fan(Vertex from, Vertex to) {
  // The sweep follows twins, which do not change, so changing origins during it is safe.
  for (const Halfedge h : halfedges_around(mesh_, from)) {
    set_origin(h, to);
  }
}

void MeshEditor::start_fan_at_boundary(Vertex v, Halfedge spoke) {
  set_outgoing(v, first_of_fan(mesh_, spoke));
}

void MeshEditor::merge_bow_tie_copies(Vertex removed, Vertex kept, const glm::vec3& p) {
  const auto stays = [&](Vertex v) { return mesh_.is_bow_tie_copy(v) && mesh_.position(v) == p; };
  if (!mesh_.is_bow_tie_copy(removed) && !mesh_.is_bow_tie_copy(kept)) return;
  const bool keeps = stays(kept);
  const bool moves = !keeps && stays(removed);
  mesh_.bow_tie_copies_ = renamed(mesh_.bow_tie_copies(), [&](Vertex v) {
    if (v == removed) return moves ? kept : Vertex{};
    return v == kept && !keeps ? Vertex{} : v;
  });
}

CollapseResult::Move MeshEditor::remove_vertex(Vertex v) {
  const Vertex last(mesh_.vertex_count() - 1);
  CollapseResult::Move move;
  if (v != last) {
    move_fan(last, v);
    mesh_.position_[v.index()] = mesh_.position_[last.index()];
    mesh_.changes_.note(GpuArray::position, v.index());
    mesh_.outgoing_[v.index()] = mesh_.outgoing_[last.index()];
    if (!mesh_.vertex_sharpness_.empty()) {
      mesh_.vertex_sharpness_[v.index()] = mesh_.vertex_sharpness_[last.index()];
    }
    if (mesh_.is_bow_tie_copy(last)) {
      mesh_.bow_tie_copies_ =
          renamed(mesh_.bow_tie_copies(), [&](Vertex copy) { return copy == last ? v : copy; });
    }
    move = {last.index(), v.index()};
  }
  mesh_.position_.pop_back();
  mesh_.outgoing_.pop_back();
  if (!mesh_.vertex_sharpness_.empty()) mesh_.vertex_sharpness_.pop_back();
  return move;
}

CollapseResult::Move MeshEditor::remove_face(Face f) {
  const Face last(mesh_.face_count() - 1);
  CollapseResult::Move move;
  if (f != last) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Halfedge from = Mesh::halfedge(last, c);
      const Halfedge to = Mesh::halfedge(f, c);
      const Vertex v = mesh_.origin(from);
      mesh_.origin_[to.index()] = v;
      mesh_.twin_[to.index()] = mesh_.twin(from);
      mesh_.sharpness_[to.index()] = mesh_.sharpness(from);
      // Noted although its class stays: the half-edge that represents the edge may change.
      if (mesh_.twin(from).is_valid()) set_twin(mesh_.twin(from), to);
      if (mesh_.outgoing(v) == from) mesh_.outgoing_[v.index()] = to;
    }
    mesh_.changes_.note(GpuArray::origin, 3 * f.index(), 3);
    mesh_.changes_.note(GpuArray::edge_class, 3 * f.index(), 3);
    move = {last.index(), f.index()};
  }
  const std::size_t halfedges = mesh_.origin_.size() - 3;
  mesh_.origin_.resize(halfedges);
  mesh_.twin_.resize(halfedges);
  mesh_.sharpness_.resize(halfedges);
  return move;
}

}  // namespace mesher
