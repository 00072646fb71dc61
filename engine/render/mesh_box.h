#pragma once

#include <cstdint>

#include "engine/mesh/mesh.h"
#include "engine/mesh/statistics.h"
#include "engine/render/sources.h"

namespace mesher::render {

/// A box around all that is drawn of a mesh: its positions, and where there are splits also every
/// place at which a vertex starts or pauses while they grow. (A vertex is always drawn within the
/// convex hull of its own places at the levels so far, since the older of two splits has grown
/// more.) Never shrinks while edits go on.
class MeshBox {
 public:
  const Box& get() const { return box_; }

  /// Takes in what `mesh.changes()` names; all where that is everything. O(changes); the first time
  /// that a level is reached also the splits that moved each of those vertices.
  void update(const Mesh& mesh, const MorphSource& morph, bool is_new_mesh);

 private:
  Box box_;
  std::uint32_t walked_vertices_ = 0;  ///< the largest mesh whose splits have been looked at
};

}  // namespace mesher::render
