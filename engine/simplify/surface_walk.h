#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "engine/analysis/triangle_tree.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/seams.h"

namespace mesher::simplify {

/// A point of a surface that is the nearest one to some other point.
struct NearPoint {
  Face face;
  glm::dvec3 weights{1.0, 0.0, 0.0};  ///< barycentric; exactly 1 at a corner
  double distance2 = std::numeric_limits<double>::infinity();
};

/// Finds nearest points by walking over faces without crossing a line, so that both sides of a seam
/// stay apart. For one thread.
class SurfaceWalk {
 public:
  SurfaceWalk(const Mesh& mesh, const Lines& lines) : mesh_(mesh), lines_(lines) {}

  /// Returns the nearest point to `p` that a walk from `start` towards it finds. The nearest face
  /// is always expanded first. A walk does not leave the vicinity of `p`, or it could go around a
  /// seam to its other side. O(length of the walk).
  NearPoint nearest(Face start, const glm::dvec3& p);
  /// Returns whether a walk leads from one point near `p` to another without leaving its vicinity.
  bool are_connected(const NearPoint& a, const NearPoint& b, const glm::dvec3& p);

 private:
  void begin();
  template <class Visit>
  void for_each_neighbor(Face f, Visit&& visit);

  const Mesh& mesh_;
  const Lines& lines_;
  std::vector<Face> visited_;  // short: walks are
  std::vector<NearPoint> front_;
};

/// Finds where a walk should have ended that got lost: collapses may take a face far from where it
/// was, and a walk from there may end at a hole or in a bay of the chart's outline.
class WalkRescue {
 public:
  /// Pre: the mesh has faces. O(F).
  WalkRescue(const Mesh& mesh, const Lines& lines);

  /// If a walk ended much farther from `p` than the nearest face, returns a face of the same chart
  /// that is nearer; otherwise nothing. Lines separate charts. O(log F) expected.
  std::optional<Face> nearer(const NearPoint& end, const glm::dvec3& p) const;

 private:
  const Mesh& mesh_;
  analysis::TriangleTree tree_;
  std::vector<std::uint32_t> chart_;
};

}  // namespace mesher::simplify
