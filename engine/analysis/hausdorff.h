#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/triangle_tree.h"
#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// The lower and upper bound of a distance, in model units.
struct DistanceInterval {
  double lower = 0.0;
  double upper = 0.0;
};

/// Bounds for the Hausdorff distance of two surfaces: the largest distance, over all points of the
/// faces.
struct HausdorffBounds {
  DistanceInterval forward;   ///< from any point of the first surface to the second
  DistanceInterval backward;  ///< from any point of the second to the first

  /// The faces of the first surface that have, or may have, a point farther than `enough` from the
  /// second, and those near points of the second that are, or may be, farther than `enough` from
  /// the first. Ascending; empty unless `finds_all` is set.
  std::vector<Face> beyond;
  /// The faces of the second surface that have, or may have, a point farther than `enough` from the
  /// first. Ascending; empty unless `finds_all` is set.
  std::vector<Face> beyond_of_second;

  /// Returns the larger of the two.
  DistanceInterval two_sided() const;
};

struct HausdorffOptions {
  /// Stop when the two-sided upper bound is at most this multiple of the lower bound. Pre: above 1.
  double ratio = 1.1;
  /// Also stop when the upper bound is at most this distance: the question is then whether the
  /// surfaces are that close, not how close they are.
  double enough = 0.0;
  /// Also stop when the lower bound exceeds `enough`, for callers that need only this decision.
  bool is_decision = false;
  /// An upper bound that is known already. Stop if it is at most `ratio` times the distance of the
  /// farthest vertex.
  double known_upper = std::numeric_limits<double>::infinity();
  /// Stop after about this many nearest-point queries and return the current bounds.
  std::uint64_t most_queries = 4'000'000;
  /// For a decision: do not stop at the first point beyond `enough`, but find all of them.
  bool finds_all = false;
  Progress* progress = nullptr;
};

/// A surface from which distances are measured, with starting points for the search.
struct HausdorffSide {
  const Mesh& mesh;
  LazyTree& tree;  ///< of the same mesh
  /// For each face, a face of the other surface that is probably near; empty: unknown. With hints
  /// for both surfaces, `skim` settles most faces before any tree is built.
  std::span<const Face> hints{};
  /// If set, only these faces are measured, not all of the surface; ascending. Pre: there are hints
  /// for both surfaces.
  std::optional<std::span<const Face>> only{};
};

/// Returns bounds for the two-sided distance of two surfaces. They hold for any meshes, and include
/// rounding: the upper bound is inflated by 1e-12 of itself plus 2^-48 of the largest coordinate
/// (computed distances are those of surface points whose coordinates are rounded to 2^-53).
/// Isolated vertices do not count. The result is the same for any number of threads.
///
/// The method is branch and bound over triangles. The distance to a convex set is a convex
/// function, so over a triangle the distance to any one triangle of the other surface is largest at
/// a corner. Also, the distance of a point to the surface exceeds that of a corner by at most the
/// distance between point and corner. A triangle whose bound is too large is halved (after L.
/// Sacht, A. Jacobson, "Cascading upper bounds for triangle soup Pompeiu-Hausdorff distance", 2024;
/// M. Tang, M. Lee, Y. Kim, "Interactive Hausdorff distance computation for general polygonal
/// models", 2009).
///
/// O(F log F) if the distance is not small relative to the triangles; never more than
/// `most_queries`. Throws Cancelled. Pre: both meshes have faces.
HausdorffBounds hausdorff_bounds(const HausdorffSide& a, const HausdorffSide& b,
                                 const HausdorffOptions& options = {});
/// The same, without hints; builds the trees itself.
HausdorffBounds hausdorff_bounds(const Mesh& a, const Mesh& b,
                                 const HausdorffOptions& options = {});

}  // namespace mesher::analysis
