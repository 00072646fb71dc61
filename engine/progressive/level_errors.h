#pragma once

#include <cstdint>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// About how far the levels of a progressive mesh lie from its full detail: the farthest that any
/// split above a level moves the surface, which is measured between the faces around its vertices
/// before and after. Falls from the base to 0 at full detail. An estimate: what splits move one
/// after the other is not added up.
class LevelErrors {
 public:
  LevelErrors() = default;
  /// Walks down from full detail, and leaves `mesh` at its level. O(splits); 4 bytes a split.
  /// Throws Cancelled.
  explicit LevelErrors(ProgressiveMesh& mesh, Progress* progress = nullptr);

  /// In model units. Pre: level <= splits.
  double error(std::uint32_t level) const;
  /// The coarsest level that is off by no more than `error`. O(log splits).
  std::uint32_t level_within(double error) const;

 private:
  Array<float> errors_;  ///< of each level but the last
};

}  // namespace mesher::progressive
