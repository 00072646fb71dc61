#pragma once

#include <algorithm>
#include <span>

#include "engine/mesh/mesh.h"
#include "engine/progressive/vertex_split.h"

namespace mesher::progressive {

/// The mesh arrays that a step writes, long enough for the finer of its two levels.
struct StepArrays {
  glm::vec3* position;
  Vertex* origin;
  Halfedge* twin;
  Halfedge* outgoing;
  float* sharpness;
  float* corner_sharpness;  ///< null if the mesh has none
};

/// A split with everything that a step needs.
struct SplitStep {
  const VertexSplit& split;
  Vertex child;
  bool is_pair;  ///< adds two faces
  std::span<const Halfedge> moved;
  const SplitSharpness* sharpness;               ///< null: nothing is sharp
  const SplitCornerSharpness* corner_sharpness;  ///< null if the mesh has none
};

/// Records nothing.
struct NoNotes {
  void operator()(GpuArray, std::uint32_t, std::uint32_t = 1) const {}
};

/// Records what a step changes in the GPU's arrays.
class Notes {
 public:
  explicit Notes(ChangeLog& log) : log_(log) {}
  void operator()(GpuArray array, std::uint32_t first, std::uint32_t count = 1) const {
    log_.note(array, first, count);
  }

 private:
  ChangeLog& log_;
};

template <class Note>
void note_step(const SplitStep& step, const Note& note) {
  const VertexSplit& s = step.split;
  note(GpuArray::position, s.parent.index());
  note(GpuArray::position, step.child.index());
  for (const Halfedge h : step.moved)
    note(GpuArray::origin, h.index());
  for (const Halfedge h : s.beyond) {
    if (h.is_valid()) note(GpuArray::edge_class, h.index());
  }
  const std::uint32_t count = step.is_pair ? 6 : 3;
  note(GpuArray::origin, 3 * s.first_face, count);
  note(GpuArray::edge_class, 3 * s.first_face, count);
}

/// Opens one face: `outer` and `inner`, twins so far, become the twins of `side` and `side + 1`.
inline void open_side(const StepArrays& a, std::uint32_t side, Halfedge outer, Halfedge inner) {
  a.twin[side] = outer;
  a.twin[side + 1] = inner;
  if (outer.is_valid()) a.twin[outer.index()] = Halfedge(side);
  if (inner.is_valid()) a.twin[inner.index()] = Halfedge(side + 1);
}

inline void close_side(Halfedge* twin, Halfedge outer, Halfedge inner) {
  if (outer.is_valid()) twin[outer.index()] = inner;
  if (inner.is_valid()) twin[inner.index()] = outer;
}

/// Returns the vertex opposite the parent on one side, before or after a split.
inline Vertex apex(const StepArrays& a, Halfedge into_parent, Halfedge out_of_parent) {
  return into_parent.is_valid() ? a.origin[into_parent.index()]
                                : a.origin[Mesh::next(out_of_parent).index()];
}

inline void set_sharpness(float* of, Halfedge h, float sharpness) {
  if (h.is_valid()) of[h.index()] = sharpness;
}

inline void refine_sharpness(const StepArrays& a, const SplitStep& step) {
  const std::uint32_t e = 3 * step.split.first_face;
  const std::uint32_t count = step.is_pair ? 6 : 3;
  if (step.sharpness == nullptr) {
    std::fill_n(a.sharpness + e, count, 0.0F);
    return;
  }
  const SplitSharpness& s = *step.sharpness;
  a.sharpness[e] = s.edge;
  a.sharpness[e + 1] = s.sides[0];
  a.sharpness[e + 2] = s.sides[1];
  if (step.is_pair) {
    a.sharpness[e + 3] = s.edge;
    a.sharpness[e + 4] = s.sides[2];
    a.sharpness[e + 5] = s.sides[3];
  }
  for (std::size_t i = 0; i < 4; ++i)
    set_sharpness(a.sharpness, step.split.beyond[i], s.sides[i]);
}

inline void coarsen_sharpness(float* of, const VertexSplit& split, const SplitSharpness& s) {
  for (std::size_t i = 0; i < 4; i += 2) {
    for (std::size_t k = i; k < i + 2; ++k)
      set_sharpness(of, split.beyond[k], std::max(s.sides[i], s.sides[i + 1]));
  }
}

/// Goes from level i to i + 1. O(moved).
template <class Note>
void refine(const StepArrays& a, const SplitStep& step, const Note& note) {
  const VertexSplit& s = step.split;
  const auto& [into_parent, out_of_child, into_child, out_of_parent] = s.beyond;
  const std::uint32_t e = 3 * s.first_face;
  const Vertex left = apex(a, into_parent, out_of_child);
  a.position[s.parent.index()] = s.fine_position;
  a.position[step.child.index()] = s.child_position;
  a.outgoing[s.parent.index()] = s.fine_outgoing;
  a.outgoing[step.child.index()] = s.child_outgoing;
  a.origin[e] = step.child;
  a.origin[e + 1] = s.parent;
  a.origin[e + 2] = left;
  a.twin[e] = step.is_pair ? Halfedge(e + 3) : Halfedge{};
  open_side(a, e + 1, into_parent, out_of_child);
  if (!out_of_child.is_valid()) a.outgoing[left.index()] = Halfedge(e + 2);
  if (step.is_pair) {
    const Vertex right = apex(a, into_child, out_of_parent);
    a.origin[e + 3] = s.parent;
    a.origin[e + 4] = step.child;
    a.origin[e + 5] = right;
    a.twin[e + 3] = Halfedge(e);
    open_side(a, e + 4, into_child, out_of_parent);
    if (!out_of_parent.is_valid()) a.outgoing[right.index()] = Halfedge(e + 5);
  }
  for (const Halfedge h : step.moved)
    a.origin[h.index()] = step.child;
  refine_sharpness(a, step);
  if (step.corner_sharpness != nullptr) {
    a.corner_sharpness[s.parent.index()] = step.corner_sharpness->fine_parent;
    a.corner_sharpness[step.child.index()] = step.corner_sharpness->child;
  }
  note_step(step, note);
}

/// Goes from level i + 1 to i. O(moved).
template <class Note>
void coarsen(const StepArrays& a, const SplitStep& step, const Note& note) {
  const VertexSplit& s = step.split;
  const auto& [into_parent, out_of_child, into_child, out_of_parent] = s.beyond;
  const std::uint32_t e = 3 * s.first_face;
  a.position[s.parent.index()] = s.coarse_position;
  a.outgoing[s.parent.index()] = s.coarse_outgoing;
  if (!out_of_child.is_valid()) a.outgoing[a.origin[e + 2].index()] = into_parent;
  close_side(a.twin, into_parent, out_of_child);
  if (step.is_pair) {
    if (!out_of_parent.is_valid()) a.outgoing[a.origin[e + 5].index()] = into_child;
    close_side(a.twin, into_child, out_of_parent);
  }
  for (const Halfedge h : step.moved)
    a.origin[h.index()] = s.parent;
  if (step.sharpness != nullptr) coarsen_sharpness(a.sharpness, s, *step.sharpness);
  if (step.corner_sharpness != nullptr) {
    a.corner_sharpness[s.parent.index()] = step.corner_sharpness->coarse_parent;
  }
  note_step(step, note);
}

}  // namespace mesher::progressive
