#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/analysis/surface_point.h"
#include "engine/analysis/triangle_tree.h"
#include "engine/core/array.h"
#include "engine/core/progress.h"

namespace mesher::analysis {

/// Points of one surface, spread evenly over its area, with the nearest points of another.
///
/// Where the nearest point lies on an edge, or where two sheets lie back to back, several faces are
/// equally near, and their attributes may differ. All of them are candidates; a measure takes the
/// one that suits it best, so that a seam is no error.
class SurfaceMatches {
 public:
  std::size_t count() const { return samples_.size(); }
  const SurfacePoint& sample(std::size_t i) const { return samples_[i]; }
  /// Returns the nearest points of the other surface, at least one.
  std::span<const SurfacePoint> candidates(std::size_t i) const {
    return std::span(candidates_).subspan(first_[i], first_[i + 1] - first_[i]);
  }

 private:
  friend SurfaceMatches match_surfaces(const Mesh& from, const Mesh& to, const TriangleTree& tree,
                                       std::uint64_t samples, Progress* progress);
  Array<SurfacePoint> samples_;
  Array<std::uint64_t> first_;  ///< index of each sample's first candidate, and the end
  Array<SurfacePoint> candidates_;
};

/// Returns the distance within which faces of a mesh count as equally near: a millionth of its
/// diagonal. O(V).
double equally_near(const Mesh& mesh);

/// Finds the nearest points of a surface, for one thread. If more than kMostCandidates faces are
/// equally near, the others are left out.
class NearestPoints {
 public:
  static constexpr std::size_t kMostCandidates = 32;

  /// `tree` must outlive this object; `tolerance` is equally_near() of its mesh.
  NearestPoints(const TriangleTree& tree, double tolerance) : tree_(tree), tolerance_(tolerance) {}
  /// Returns the points, at least one, until the next call. The same whatever was asked before.
  /// O(log F) expected.
  std::span<const SurfacePoint> nearest(const glm::dvec3& position);

 private:
  const TriangleTree& tree_;
  double tolerance_;
  Face hint_{0};
  std::vector<Face> faces_;
  std::vector<SurfacePoint> points_;
};

/// Returns the matches of `samples` points of `from` on `to`, whose tree is `tree`. The same for
/// any number of threads; O(samples log F) expected, parallel. Memory: about 50 bytes per sample.
/// Throws Cancelled. Pre: both meshes have faces.
SurfaceMatches match_surfaces(const Mesh& from, const Mesh& to, const TriangleTree& tree,
                              std::uint64_t samples, Progress* progress = nullptr);

}  // namespace mesher::analysis
