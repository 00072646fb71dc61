#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/change_log.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/wedges.h"

namespace mesher::progressive {

/// A corner whose wedge a split changes, and its wedge on the other side of the split: after it
/// while the level is at or below the split, before it otherwise.
struct CornerChange {
  Halfedge corner;
  Wedge other;
  friend bool operator==(const CornerChange&, const CornerChange&) = default;
};

/// The attributes of a progressive mesh at every level, and a current level that can move both
/// ways (H. Hoppe, "Efficient implementation of progressive meshes", 1998).
///
/// Wedges and faces are numbered in order of appearance, so every level is a prefix of the full
/// arrays: of `corner_wedges` by the level's faces, of the layers by its wedges. Elements past the
/// prefix keep the values with which they appear. A split adds wedges, gives corners of existing
/// faces other wedges, and gives wedges of its parent other values. A step swaps both with those of
/// the other level, so it is exact and its own inverse.
///
/// Invariants:
///  W1. A corner of level i has a wedge below wedge_count(i), and each such wedge has a corner.
///  W2. The corners of a wedge are at one vertex.
///  W3. A level's elements do not depend on the path to it.
///  W4. A split lists no corner and no wedge twice, and only those that exist before it.
///
/// Memory: the attributes, 12 bytes per split, 8 per changed corner (3 to 4 per split), and a value
/// per changed wedge (about one per split).
class ProgressiveAttributes {
 public:
  std::uint32_t level() const { return level_; }
  std::uint32_t split_count() const { return static_cast<std::uint32_t>(splits_.size()); }
  bool is_empty() const { return arrays_.is_empty(); }
  /// Returns whether there are no values. There may be groups.
  bool has_no_layers() const { return arrays_.layers.empty(); }
  std::uint32_t wedge_count(std::uint32_t level) const {
    return level < split_count() ? splits_[level].first_wedge : full_wedges_;
  }

  /// Moves to a level, split by split. Records in changes() what it writes; a long way counts as a
  /// change of everything. O(steps). Pre: level <= split_count().
  void go_to(std::uint32_t level);

  /// Returns all arrays: those of the level, and the elements that finer levels add. `further` is
  /// empty, so they break the invariants of Attributes: use `at_level` for anything but drawing.
  const Attributes& arrays() const { return arrays_; }
  /// The elements of `arrays` that steps have changed: corner_wedge and wedge_value. Elements past
  /// the level's own never change.
  ChangeLog& changes() { return changes_; }

  /// Wedge of each corner. Only those of the level's faces are its own.
  std::span<const Wedge> corner_wedges() const { return arrays_.corner_wedge; }
  /// Values of each wedge. Only those below wedge_count(level()) are the level's own.
  std::span<const AttributeLayer> layers() const { return arrays_.layers; }
  /// Group of each face of the full mesh; empty if there are none.
  std::span<const std::uint32_t> group() const { return arrays_.group; }
  const std::vector<FaceGroup>& groups() const { return arrays_.groups; }
  /// Changes what a group says.
  FaceGroup& group_entry(std::size_t index) { return arrays_.groups[index]; }
  /// Returns whether a layer has a normal per face, which coarse levels compute from their faces.
  bool is_faceted(std::size_t layer) const { return is_faceted_[layer] != 0; }

  std::span<const CornerChange> corner_changes(std::uint32_t split) const {
    return part(corner_changes_, split, &Split::first_corner);
  }
  /// Returns the wedges whose values a split changes.
  std::span<const Wedge> changed_wedges(std::uint32_t split) const {
    return part(changed_wedges_, split, &Split::first_value);
  }
  /// Values of each changed wedge on the other side of its split.
  std::span<const AttributeLayer> other_values() const { return others_; }

  /// Returns the attributes of the current level. Coarse levels of a faceted model have a normal
  /// per face, as the model has. O(F). Pre: `mesh` is that level of the mesh.
  Attributes at_level(const Mesh& mesh, Progress* progress = nullptr) const;

  /// Returns the bytes that the arrays occupy.
  std::size_t memory_bytes() const;

 private:
  friend class AttributeAppender;
  friend class AttributeRecorder;

  /// Where the elements of a split begin. They end where those of the next split begin.
  struct Split {
    std::uint32_t first_wedge = 0;
    std::uint32_t first_corner = 0;
    std::uint32_t first_value = 0;
  };

  template <class T>
  std::span<const T> part(const Array<T>& all, std::uint32_t split,
                          std::uint32_t Split::*first) const {
    const std::size_t begin = splits_[split].*first;
    const bool is_last = split + 1 == split_count();
    return std::span(all).subspan(begin,
                                  (is_last ? all.size() : splits_[split + 1].*first) - begin);
  }
  void swap(std::uint32_t split);
  std::vector<AttributeStream> streams(const Mesh& mesh) const;

  std::uint32_t level_ = 0;
  std::uint32_t full_wedges_ = 0;
  Array<Split> splits_;
  Attributes arrays_;  ///< corners, wedges and faces of the full mesh
  ChangeLog changes_;
  Array<CornerChange> corner_changes_;    ///< by split
  Array<Wedge> changed_wedges_;           ///< by split
  std::vector<AttributeLayer> others_;    ///< per changed wedge: its value on the other side
  std::vector<std::uint8_t> is_faceted_;  ///< by layer: its normals differ across most edges
};

}  // namespace mesher::progressive
