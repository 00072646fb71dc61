#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/mesh/shape.h"
#include "engine/simplify/cards.h"
#include "engine/simplify/options.h"
#include "engine/simplify/report.h"

namespace mesher::simplify {

/// A mesh of a scene, in its own units. What it refers to must outlive all that uses it.
struct SceneShape {
  const Mesh& mesh;
  const Attributes& attributes;
  std::uint64_t weight = 1;  ///< how often the scene shows it; 0: never
  double scale = 1.0;        ///< factor of lengths from the mesh to the scene; above 0
};

/// How the shapes of a scene are simplified.
struct ShapesOptions {
  /// The rules. Error limits are in units of the scene, and targets are ignored.
  SimplifyOptions rules;
  bool prunes = false;       ///< as simplify_model
  bool keeps_cards = false;  ///< loose cards are collapsed as other parts, and never removed
  bool per_shape = false;    ///< the same share of faces for each shape
};

/// A simplified shape. Lengths of the report are in units of the mesh.
struct ReducedShape {
  Shape shape;
  SimplifyReport report;
  bool crosses_seams = false;
  ThinnedCards cards;
};

/// Simplifies the meshes of a scene to one budget of faces (`distribute`,
/// engine/simplify/budget.h), by error in units of the scene.
///
/// Loose cards (engine/simplify/cards.h) are not collapsed but removed at random, and the others
/// enlarged. They take part in the budget as a mesh of their own, so they are thinned only where
/// that is cheaper than collapses elsewhere. Not with an error bound, which a removed card would
/// break. Shapes that the scene does not show keep the same share of faces as the scene.
///
/// Results do not depend on the number of threads.
class ShapesReducer {
 public:
  /// Finds loose cards. O(F).
  ShapesReducer(const std::vector<SceneShape>& shapes, const ShapesOptions& options);
  ~ShapesReducer();
  ShapesReducer(const ShapesReducer&) = delete;
  ShapesReducer& operator=(const ShapesReducer&) = delete;

  /// Returns the shapes with at most `faces` faces as shown, or as few as is legal; 0: no target.
  /// The first call takes the time of simplifying each shape to the fewest faces, unless there is
  /// just one thing to simplify; each call takes that of simplifying each shape to its number of
  /// faces. If a shape cannot reach its number, others get fewer faces, at most kMostRepeats times.
  /// Throws Cancelled.
  std::vector<ReducedShape> reduce(std::uint64_t faces, Progress* progress = nullptr);

  static constexpr int kMostRepeats = 2;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mesher::simplify
