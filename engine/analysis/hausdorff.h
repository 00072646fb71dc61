#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/analysis/triangle_tree.h"
#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Two numbers between which a distance lies, in model units.
struct DistanceInterval {
  double lower = 0.0;
  double upper = 0.0;
};

/// How far the surfaces lie apart at most (the Hausdorff distance, all points of the faces
/// counted).
struct HausdorffBounds {
  DistanceInterval forward;   ///< from any point of the first surface to the second
  DistanceInterval backward;  ///< from any point of the second to the first

  /// Faces of the first surface where a point is, or may be, farther than enough from the second or
  /// where one of the second is, or may be, farther from them. Ascending; where `finds_all` alone.
  std::vector<Face> beyond;

  /// The larger of the two.
  DistanceInterval two_sided() const;
};

struct HausdorffOptions {
  /// The work ends as soon as the two-sided upper bound is at most so many times the lower one.
  /// Pre: above 1.
  double ratio = 1.1;
  /// It also ends as soon as the upper bound is at most that: what is asked is whether the distance
  /// is, not what it is.
  double enough = 0.0;
  /// And as soon as the lower bound is above `enough`, where that is all there is to know.
  bool is_decision = false;
  /// After about so many nearest-point queries the bounds are returned as they are.
  std::uint64_t most_queries = 4'000'000;
  /// A decision that does not end at the first point beyond, but finds out where they all are.
  bool finds_all = false;
  Progress* progress = nullptr;
};

/// A surface from which distances are measured, and where the measuring may begin.
struct HausdorffSide {
  const Mesh& mesh;
  LazyTree& tree;  ///< of the same mesh
  /// For each face one of the other surface that is likely to be near; empty: none is known. With
  /// hints for both surfaces most faces are done with before any tree is built (`skim`).
  std::span<const Face> hints{};
};

/// Bounds for the two-sided distance of two surfaces that hold whatever the meshes are; also for
/// what rounding does, by an inflation of the upper bound of 1e-12 of itself and 2^-48 of the
/// largest coordinate (computed distances are those of points of the surfaces whose coordinates are
/// rounded to 2^-53). Isolated vertices do not count. The same for any number of threads.
///
/// Branch and bound over triangles: the distance to a convex set is a convex function, so over a
/// triangle the distance to any one triangle of the other surface is largest at a corner; and no
/// point is farther from the surface than a corner is by more than its own distance to that corner.
/// A triangle whose bound is too large is halved (after L. Sacht, A. Jacobson, "Cascading upper
/// bounds for triangle soup Pompeiu-Hausdorff distance", 2024; M. Tang, M. Lee, Y. Kim,
/// "Interactive Hausdorff distance computation for general polygonal models", 2009). O(F log F)
/// where the distance is not small against the triangles; never more than `most_queries`. Pre: both
/// meshes have faces. Throws Cancelled.
HausdorffBounds hausdorff_bounds(const HausdorffSide& a, const HausdorffSide& b,
                                 const HausdorffOptions& options = {});
/// The same, with trees of its own.
HausdorffBounds hausdorff_bounds(const Mesh& a, const Mesh& b,
                                 const HausdorffOptions& options = {});

}  // namespace mesher
