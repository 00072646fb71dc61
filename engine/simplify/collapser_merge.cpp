// The part of Collapser that performs a collapse: changes the mesh and updates shapes and quadrics.
#include <algorithm>
#include <array>

#include "engine/mesh/collapse.h"
#include "engine/mesh/mesh_editor.h"
#include "engine/simplify/collapser.h"

namespace mesher::simplify {

/// Pre: the fan is gathered, and its shape is checked at the step's position.
void Collapser::apply(CollapseStep step) {
  Surface& surface = context_.surface;
  const auto& [h, t, removed, kept, position, rank] = step.record;
  note(step);
  context_.policy.collapsing(surface, h, fan_, position);
  if (fan_.is_smooth()) {
    merge_smooth(h, position);
  } else {
    merge_near_feature(h, position);
  }
  if (context_.bound != nullptr) {
    step.is_plain = ErrorBound::covers_all(fan_);
    context_.bound->collapsed(step);
    outcome_.steps.push_back(step);
  }
  if (guard_) guard_->collapsed(surface, fan_);
  if (context_.samples != nullptr) context_.samples->collapsed(fan_);
}

/// Does the bookkeeping of a collapse that is about to be done.
void Collapser::note(const CollapseStep& step) {
  const auto& [h, t, removed, kept, position, rank] = step.record;
  MESHER_ASSERT(check_collapse(context_.surface.mesh(), h).is_legal());
  outcome_.records.push_back(step.record);
  outcome_.paid += double{step.error};
  outcome_.removed_faces += t.is_valid() ? 2 : 1;
  // The rank is stored where later collapses look for it.
  for (const Vertex v : fan_.ring())
    state(v).set_rank(rank);
  state(kept).set_rank(rank);
  if (guard_) least_rank_ = static_cast<std::uint16_t>(rank);
  queue_.remove(removed);
  queue_.remove(kept);
  state(kept).is_guarded |= state(removed).is_guarded;
  state(removed).remove(kept);
  state(kept).set_retreat(step.retreat);
}

/// Adds (+1) or removes (-1) the face's quadric at its three corners.
void Collapser::add_contributions(Face f, float sign) {
  Surface& surface = context_.surface;
  const auto q = surface.contributions(f);
  for (std::uint32_t c = 0; c < 3; ++c) {
    Quadric<float>& sum = surface.state(surface.mesh().origin(Mesh::halfedge(f, c))).quadric;
    sum = sign > 0.0F ? sum + q[c] : sum - q[c];
  }
}

/// Merges the edge and updates shapes and quadrics; handles faces with features.
void Collapser::merge_near_feature(Halfedge h, const glm::vec3& p) {
  Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  const Vertex kept = mesh.target(h);
  for (const Halfedge spoke : fan_.spokes())
    add_contributions(Mesh::face(spoke), -1.0F);
  for (const Halfedge side : {h, mesh.twin(h)}) {
    if (side.is_valid()) add_contributions(Mesh::face(side), -1.0F);
  }
  merge(h, p);
  surface.move_and_clear_quadric(kept, p);
  for (std::size_t i = 0; i < fan_.size(); ++i)
    surface.set_shape(Mesh::face(fan_.spokes()[i]), fan_.four_shapes(i)[0]);
  for (const Halfedge spoke : fan_.spokes())
    add_contributions(Mesh::face(spoke), 1.0F);
}

/// Same, for faces that contribute only their planes: writes each neighbor once.
void Collapser::merge_smooth(Halfedge h, const glm::vec3& p) {
  Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  const Vertex kept = mesh.target(h);
  for (const Halfedge side : {h, mesh.twin(h)}) {
    surface.add(mesh.origin(Mesh::prev(side)),
                QuadricRows{} - plane_rows(surface.shape_row(Mesh::face(side))));
  }
  QuadricRows total{};
  QuadricRows previous{};
  for (std::size_t i = 0; i < fan_.size(); i += 4) {
    const std::array<Float4, 4> shapes = fan_.four_shapes(i);
    for (std::size_t k = 0; k < 4 && i + k < fan_.size(); ++k) {
      const Face f = Mesh::face(fan_.spokes()[i + k]);
      const QuadricRows after = plane_rows(shapes[k]);
      const QuadricRows change = after - plane_rows(surface.shape_row(f));
      surface.add(fan_.ring()[i + k], previous + change);
      surface.set_shape(f, shapes[k]);
      total = total + after;
      previous = change;
    }
  }
  surface.add(fan_.ring().back(), previous);
  merge(h, p);
  surface.move_and_clear_quadric(kept, p);
  surface.add(kept, total);
}

void Collapser::merge(Halfedge h, const glm::vec3& p) {
  Surface& surface = context_.surface;
  MeshEditor edit(surface.mesh());
  const Mesh& mesh = surface.mesh();
  const Halfedge t = mesh.twin(h);
  const Vertex removed = mesh.origin(h);
  const Vertex kept = mesh.target(h);
  const bool is_across = surface.allowed_placement(h) == AllowedPlacement::across;
  VertexState& state = surface.state(kept);
  state.constraint = std::max(state.constraint, surface.constraint(removed));
  state.constraint_across =
      std::max(state.constraint_across, surface.state(removed).constraint_across);
  // Two features may become one at these vertices.
  std::array<Vertex, 2> opposite;
  if (!fan_.is_smooth()) {
    edit.join_sharpness(h);
    // Two edges become one, which is a feature if either was.
    for (const Halfedge side : {h, t}) {
      if (!side.is_valid()) continue;
      opposite[side == h ? 0 : 1] = mesh.origin(Mesh::prev(side));
      const EdgeKind kind =
          std::max(surface.kind(Mesh::next(side)), surface.kind(Mesh::prev(side)));
      for (const Halfedge inner : {Mesh::next(side), Mesh::prev(side)}) {
        if (mesh.twin(inner).is_valid()) surface.set_kind(mesh.twin(inner), kind);
      }
    }
  }
  edit.close_edge(h);
  for (const Halfedge spoke : fan_.spokes())
    edit.set_origin(spoke, kept);
  surface.mesh().set_position(kept, p);
  edit.take_over(removed, kept);
  edit.set_outgoing(kept, fan_.spokes().front());
  edit.set_outgoing(removed, {});
  for (const Halfedge side : {h, t}) {
    if (!side.is_valid()) continue;
    for (std::uint32_t c = 0; c < 3; ++c)
      edit.set_origin(Mesh::halfedge(Mesh::face(side), c), {});
  }
  if (!is_across) return;
  for (const Vertex v : {kept, opposite[0], opposite[1]}) {
    if (v.is_valid()) surface.update_constraint(v);
  }
}

}  // namespace mesher::simplify
