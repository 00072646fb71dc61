#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/mesh/ids.h"

namespace mesher::progressive {

/// A vertex split, the inverse of an edge collapse: a vertex, the parent, becomes two, and one or
/// two faces open between them (H. Hoppe, "Progressive meshes", 1996). Split i of a progressive
/// mesh adds vertex `base vertices + i`, the child, and the faces from `first_face` on:
///
///   first:  3f   child -> parent,  3f+1 parent -> left,  3f+2 left -> child;
///   second: 3f+3 parent -> child,  3f+4 child -> right,  3f+5 right -> parent (none on a
///   boundary).
///
/// It holds everything that a step up or down writes, so neither has to search the mesh.
struct VertexSplit {
  Vertex parent;
  std::uint32_t first_face = 0;
  /// Index into ProgressiveMesh::moved of the corners that move to the child, besides those of new
  /// faces. They end where those of the next split begin.
  std::uint32_t first_moved = 0;
  Halfedge coarse_outgoing;  ///< outgoing(parent) before the split
  Halfedge fine_outgoing;    ///< outgoing(parent) after the split
  Halfedge child_outgoing;
  /// The twins of parent -> left, left -> child, child -> right and right -> parent after the
  /// split. Before the split, the first two are each other's twins, and so are the last two.
  std::array<Halfedge, 4> beyond;
  glm::vec3 coarse_position;  ///< position of the parent before the split
  glm::vec3 fine_position;    ///< position of the parent after the split
  glm::vec3 child_position;
};

/// Sharpness of the edges that a split changes. Before the split, parent - left has the larger of
/// the two values of parent - left and left - child after it; the same holds on the right.
struct SplitSharpness {
  float edge = 0.0F;  ///< parent - child
  /// parent - left, left - child, child - right, right - parent
  std::array<float, 4> sides{};
  friend bool operator==(const SplitSharpness&, const SplitSharpness&) = default;
};

/// Sharpness of the vertices of a split themselves.
struct SplitCornerSharpness {
  float coarse_parent = 0.0F;
  float fine_parent = 0.0F;
  float child = 0.0F;
  friend bool operator==(const SplitCornerSharpness&, const SplitCornerSharpness&) = default;
};

/// Where a split cuts the faces around its parent. The edges at the parent, counterclockwise from
/// outgoing(parent), have slots 0 to k-1. At a boundary there is one more slot, k, for the last
/// edge, which has no half-edge out of the parent.
///
/// With `right`, or inside the surface: the faces from slot `left` counterclockwise to slot
/// `right` become the child's (past the end of an open fan, it continues at the beginning). Without
/// `right`, one face opens at the boundary: the faces from slot `left` to the end become the
/// child's.
struct SplitCut {
  std::uint32_t left = 0;
  std::uint32_t right = kNone;  ///< kNone: one face
  friend bool operator==(const SplitCut&, const SplitCut&) = default;
};

/// A split as stored in a file: only what cannot be derived.
struct NewSplit {
  Vertex parent;
  SplitCut cut;
  glm::vec3 parent_position;
  glm::vec3 child_position;
  SplitSharpness sharpness;
  /// After the split; ignored if the base's vertices have no sharpness of their own.
  float parent_corner_sharpness = 0.0F;
  float child_corner_sharpness = 0.0F;
};

}  // namespace mesher::progressive
