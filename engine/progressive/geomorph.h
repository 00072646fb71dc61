#pragma once

#include <cstdint>
#include <span>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/geomorph.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher {

/// What a geomorph of a progressive mesh needs beside its mesh. A vertex is drawn where the level's
/// mesh has it, less what the splits that are still growing have yet to add; a child starts where
/// its parent is drawn. So the surface is continuous in time.
///
/// Normals are one a vertex: at full detail those of the input; a parent's before a split is the
/// sum of both after it, by area. So a coarse level is shaded as the part of the input that its
/// vertices stand for, and a split changes no normals but those of parent and child, which grow
/// with it. (Creases are not split in it.)
class Geomorph {
 public:
  Geomorph() = default;
  /// Of all splits, with normals, at the mesh's level, which stays what it is. O(F + splits).
  /// Throws Cancelled. 40 bytes a split, 12 a vertex.
  explicit Geomorph(ProgressiveMesh& mesh, Progress* progress = nullptr);

  /// Takes the splits that have been appended since. Normals are forgotten: those of coarse levels
  /// follow from full detail. O(new splits).
  void extend(const ProgressiveMesh& mesh);
  /// Makes normals as said above, for the splits that there are. Leaves `mesh` at its level. O(F +
  /// splits). Throws Cancelled. Pre: nothing has been appended since `extend`.
  void find_normals(ProgressiveMesh& mesh, Progress* progress = nullptr);

  /// Brings heads and normals to the level at which `mesh` is. What differs afterwards are those of
  /// vertices whose positions the way there has noted as changed. O(steps). Pre: nothing has been
  /// appended since `extend`.
  void follow(const ProgressiveMesh& mesh);

  std::span<const SplitMorph> splits() const { return splits_; }
  std::span<const std::uint32_t> heads() const { return heads_; }  ///< one a live vertex
  /// One a live vertex, or empty where they are not known.
  std::span<const std::uint32_t> normals() const { return normals_; }

 private:
  void refine(const ProgressiveMesh& mesh, std::uint32_t split);
  void coarsen(const ProgressiveMesh& mesh, std::uint32_t split);

  std::uint32_t level_ = 0;
  Array<SplitMorph> splits_;
  Array<std::uint32_t> heads_;
  Array<std::uint32_t> normals_;
  Array<std::uint32_t> top_heads_;  ///< at full detail, one a vertex
};

}  // namespace mesher
