#pragma once

#include <cstdint>

#include "engine/mesh/mesh.h"
#include "engine/mesh/statistics.h"
#include "engine/render/sources.h"

namespace mesher::render {

/// A box around everything drawn of a mesh.
///
/// It contains the positions and, if there are splits, every position at which a vertex starts or
/// stops during a geomorph. (A vertex is always drawn within the convex hull of its positions at
/// the levels so far, since the older of two splits has grown more.) Never shrinks during edits.
class MeshBox {
 public:
  const Box& get() const { return box_; }

  /// Adds the vertices in `mesh.changes()`, or all if everything changed. When a level is first
  /// reached, also adds the positions of the splits that moved each of those vertices. O(changes),
  /// plus those splits.
  void update(const Mesh& mesh, const MorphSource& morph, bool is_new_mesh);

 private:
  Box box_;
  std::uint32_t walked_vertices_ = 0;  ///< vertices of the largest mesh whose splits are included
};

}  // namespace mesher::render
