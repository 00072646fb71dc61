#pragma once

#include <cstdint>
#include <span>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/geomorph.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// Data of a geomorph beside the progressive mesh. A vertex is drawn at its position in the level's
/// mesh, minus what the growing splits have not added yet; a child starts where its parent is
/// drawn. So the surface is continuous in time.
///
/// There is one normal per vertex. At full detail it is that of the input; a parent's normal before
/// a split is the area-weighted sum of both normals after it. So a coarse level is shaded like the
/// part of the input that its vertices represent, and a split changes only the normals of parent
/// and child, which are interpolated with it. (Normals are not split at creases.)
class Geomorph {
 public:
  Geomorph() = default;
  /// For all splits, with normals, at the mesh's current level; `mesh` ends at the level it had.
  /// O(F + splits). Throws Cancelled. 40 bytes per split, 12 per vertex.
  explicit Geomorph(ProgressiveMesh& mesh, Progress* progress = nullptr);

  /// Adds the splits that were appended since. Clears the normals, because those of coarse levels
  /// depend on full detail. O(new splits).
  void extend(const ProgressiveMesh& mesh);
  /// Computes normals as described above for all current splits. Leaves `mesh` at its level. O(F +
  /// splits). Throws Cancelled. Pre: nothing was appended since `extend`.
  void find_normals(ProgressiveMesh& mesh, Progress* progress = nullptr);

  /// Updates heads and normals to the level of `mesh`. They change only for vertices whose
  /// positions mesh().changes() lists for the same steps. O(steps). Pre: nothing was appended since
  /// `extend`.
  void follow(const ProgressiveMesh& mesh);

  std::span<const SplitMorph> splits() const { return splits_; }
  std::span<const std::uint32_t> heads() const { return heads_; }  ///< one per live vertex
  /// One per live vertex; empty if unknown.
  std::span<const std::uint32_t> normals() const { return normals_; }

 private:
  void refine(const ProgressiveMesh& mesh, std::uint32_t split);
  void coarsen(const ProgressiveMesh& mesh, std::uint32_t split);

  std::uint32_t level_ = 0;
  Array<SplitMorph> splits_;
  Array<std::uint32_t> heads_;
  Array<std::uint32_t> normals_;
  Array<std::uint32_t> top_heads_;  ///< at full detail, one per vertex
};

}  // namespace mesher::progressive
