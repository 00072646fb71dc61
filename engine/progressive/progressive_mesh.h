#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/vertex_split.h"

namespace mesher::progressive {

struct SplitStep;

/// A mesh at every level of detail from a coarse base to the full model: a base mesh, the vertex
/// splits that refine it, and a current level that can move both ways (H. Hoppe, "Efficient
/// implementation of progressive meshes", 1998). Level i is the base after the first i splits.
///
/// Vertices and faces are numbered in order of appearance, so every level is a prefix of the full
/// arrays, and a split writes only the corners around it. At each level `mesh()` is a valid Mesh;
/// the GPU draws directly from its arrays.
///
/// Invariants besides those of Mesh:
///  P1. Level i has base_vertex_count() + i vertices and face_count(i) faces.
///  P2. A level's arrays do not depend on the path to it.
///  P3. outgoing(v) of an interior vertex is its lowest outgoing half-edge.
///  P4. moved(i) are the corners of faces of level i at the parent of split i that belong to its
///      child in level i + 1: first those that follow left -> child counterclockwise; then, if
///      these end at a boundary, those that precede child -> right clockwise.
///
/// The copies of bow-tie vertices are listed at every level. An appended split may move one, so a
/// mesh assembled from a base and splits (such as one from a file) lists none.
///
/// Memory beside the mesh: 76 bytes per split and 4 per moved corner (3 to 4 corners per split).
class ProgressiveMesh {
 public:
  ProgressiveMesh() = default;
  /// A base without splits. Sets the outgoing half-edges of its vertices by P3. O(F).
  explicit ProgressiveMesh(Mesh&& base);

  /// Returns the mesh at the current level.
  const Mesh& mesh() const { return mesh_; }
  /// For clearing its changes or moving it out. Any other change breaks the invariants above.
  Mesh& mesh() { return mesh_; }
  std::uint32_t level() const { return level_; }
  std::uint32_t split_count() const { return static_cast<std::uint32_t>(splits_.size()); }
  std::uint32_t base_vertex_count() const { return base_vertices_; }
  std::uint32_t base_face_count() const { return base_faces_; }
  std::uint32_t face_count(std::uint32_t level) const {
    return level < split_count() ? splits_[level].first_face : full_faces_;
  }
  std::uint32_t full_face_count() const { return full_faces_; }
  /// Returns the highest level of at most `faces` faces; the base if there is none. O(log splits).
  std::uint32_t level_for_faces(std::uint32_t faces) const;

  /// Moves to a level, split by split. Records what it writes in mesh().changes(); a long way
  /// counts as a change of everything. O(steps). Pre: level <= split_count().
  void go_to(std::uint32_t level);

  /// Goes to the base. Calls `visit(i)` before split i is undone: connectivity and positions of
  /// mesh() are then those of level i + 1, with unused elements at the end of its arrays.
  /// O(splits). If `visit` throws, the mesh stays at level i + 1. Pre: level() == split_count().
  void undo_all(const std::function<void(std::uint32_t)>& visit);

  std::span<const VertexSplit> splits() const { return splits_; }
  Vertex child(std::uint32_t split) const { return Vertex(base_vertices_ + split); }
  /// Returns the moved corners of a split, see P4.
  std::span<const Halfedge> moved(std::uint32_t split) const {
    const std::uint32_t begin = splits_[split].first_moved;
    const bool is_last = split + 1 == split_count();
    return std::span(moved_).subspan(
        begin, (is_last ? moved_.size() : splits_[split + 1].first_moved) - begin);
  }
  /// One per split; empty if no edge of any level is sharp.
  std::span<const SplitSharpness> sharpnesses() const { return sharpness_; }
  /// One per split; empty if vertices have no sharpness of their own.
  std::span<const SplitCornerSharpness> corner_sharpnesses() const { return corner_sharpness_; }

  /// Returns whether a split with this cut may be appended: its slots exist and differ, and there
  /// are ids left. Any such split of a valid mesh yields a valid mesh. O(faces at the parent). Pre:
  /// level() == split_count().
  bool can_append(Vertex parent, const SplitCut& cut) const;
  /// Reserves memory for this many splits in total, so that appending does not move arrays. Throws
  /// std::bad_alloc.
  void reserve(std::uint32_t splits);
  /// Returns the number of splits for which memory is reserved.
  std::size_t split_capacity() const { return splits_.capacity(); }
  /// Appends a split and moves to it. O(faces at the parent). Throws std::bad_alloc. Pre:
  /// can_append; level() == split_count(); positions are finite.
  void append(const NewSplit& split);
  /// Returns split `level()` in the form that `append` takes. O(faces at the parent). Pre: level()
  /// < split_count().
  NewSplit next_split() const;

  /// Returns the bytes occupied by mesh and splits.
  std::size_t memory_bytes() const;

 private:
  friend class ProgressiveBuilder;
  friend class SplitAppender;

  SplitStep step(std::uint32_t split) const;
  Array<BowTieCopy> bow_tie_copies(std::uint32_t level) const;

  Mesh mesh_;
  std::uint32_t level_ = 0;
  std::uint32_t base_vertices_ = 0;
  std::uint32_t base_faces_ = 0;
  std::uint32_t full_faces_ = 0;
  bool has_sharp_base_ = false;
  Array<VertexSplit> splits_;
  Array<Halfedge> moved_;
  Array<SplitSharpness> sharpness_;
  Array<SplitCornerSharpness> corner_sharpness_;
  Array<BowTieCopy> full_bow_tie_copies_;  ///< at full detail
  Array<Halfedge> spokes_;                 ///< scratch of append
};

/// Brings a mesh to a level in steps, and reports them. Throws Cancelled at a level in between.
void go_to_level(ProgressiveMesh& mesh, std::uint32_t level, Progress* progress);

}  // namespace mesher::progressive
