#pragma once

#include <cstdint>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/vertex_split.h"

namespace mesher {

struct SplitStep;

/// A mesh in every level of detail from a coarse base to the full model: a base mesh and the vertex
/// splits that refine it, with a cursor that goes up and down (H. Hoppe, "Efficient implementation
/// of progressive meshes", 1998). Level i is the base after the first i splits.
///
/// Vertices and faces are numbered in the order in which they appear, so that every level is a
/// prefix of the full arrays, and a split writes nothing but the corners around it. At each level
/// `mesh()` is a valid Mesh: its arrays are those that the GPU draws from.
///
/// Invariants beside those of Mesh:
///  P1. Level i has base_vertex_count() + i vertices and face_count(i) faces.
///  P2. A level's arrays do not depend on the way to it.
///  P3. outgoing(v) of a vertex inside the surface is the lowest half-edge out of it.
///  P4. moved(i) are the corners of faces of level i at the parent of split i that are its child's
///      in level i + 1: first those that follow left -> child counter-clockwise, then, where they
///      end at a boundary, those that precede child -> right clockwise.
///
/// The copies of bow-tie vertices are listed at every level. A split that is appended may move one,
/// so a mesh that is put together of a base and splits (as one from a file is) lists none.
///
/// Beside the mesh it takes 76 bytes a split and 4 for each moved corner (3 to 4 a split).
class ProgressiveMesh {
 public:
  ProgressiveMesh() = default;
  /// A base without splits. Gives its vertices the outgoing half-edges of P3. O(F).
  explicit ProgressiveMesh(Mesh&& base);

  /// At the current level.
  const Mesh& mesh() const { return mesh_; }
  /// To clear its changes, or to take it away. Whoever changes anything else ends what is said
  /// here.
  Mesh& mesh() { return mesh_; }
  std::uint32_t level() const { return level_; }
  std::uint32_t split_count() const { return static_cast<std::uint32_t>(splits_.size()); }
  std::uint32_t base_vertex_count() const { return base_vertices_; }
  std::uint32_t base_face_count() const { return base_faces_; }
  std::uint32_t face_count(std::uint32_t level) const {
    return level < split_count() ? splits_[level].first_face : full_faces_;
  }
  std::uint32_t full_face_count() const { return full_faces_; }
  /// The highest level of at most `faces` faces, or the base. O(log splits).
  std::uint32_t level_for_faces(std::uint32_t faces) const;

  /// Steps up or down, split by split. Notes what it touches in mesh().changes(); a long way counts
  /// as a change of everything. O(steps). Pre: level <= split_count().
  void go_to(std::uint32_t level);

  std::span<const VertexSplit> splits() const { return splits_; }
  Vertex child(std::uint32_t split) const { return Vertex(base_vertices_ + split); }
  /// See P4.
  std::span<const Halfedge> moved(std::uint32_t split) const {
    const std::uint32_t begin = splits_[split].first_moved;
    const bool is_last = split + 1 == split_count();
    return std::span(moved_).subspan(
        begin, (is_last ? moved_.size() : splits_[split + 1].first_moved) - begin);
  }
  /// Empty where no edge of any level is sharp; otherwise one a split.
  std::span<const SplitSharpness> sharpnesses() const { return sharpness_; }
  /// The same for the sharpness of vertices.
  std::span<const SplitCornerSharpness> corner_sharpnesses() const { return corner_sharpness_; }

  /// Whether a split may be appended with this cut: slots exist, differ, and there are ids left.
  /// Any such split of a valid mesh gives a valid mesh. O(faces at the parent). Pre: level() ==
  /// split_count().
  bool can_append(Vertex parent, const SplitCut& cut) const;
  /// Makes room for so many splits in all, so that arrays need not move as they are appended.
  /// Throws std::bad_alloc.
  void reserve(std::uint32_t splits);
  /// For how many splits there is room.
  std::size_t split_capacity() const { return splits_.capacity(); }
  /// Adds a split after the last and goes up to it. O(faces at the parent). Throws std::bad_alloc.
  /// Pre: can_append; level() == split_count(); positions are finite.
  void append(const NewSplit& split);
  /// Split `level()` as `append` takes it. O(faces at the parent). Pre: level() < split_count().
  NewSplit next_split() const;

  /// Bytes that mesh and splits occupy.
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

}  // namespace mesher
