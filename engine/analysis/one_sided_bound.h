#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/analysis/hausdorff.h"
#include "engine/analysis/skim.h"
#include "engine/analysis/triangle_reach.h"

namespace mesher {

/// A triangle within a face.
struct BoundPiece {
  Triangle corners;
  std::array<double, 3> distance;  ///< of each corner, at most
  std::array<Face, 3> near;        ///< a face of the other surface that is so far from it
  Face below;                      ///< one that is near the middle of the face, if one is known
  double upper = 0.0;              ///< bound for all points, where it is open
  std::uint8_t cuts = 0;           ///< along triangles that made it
  Face face;                       ///< of which it is a part
};

/// What came of some of the work.
struct BoundOutcome {
  double lower = 0.0;  ///< the largest distance that was found
  double upper = 0.0;  ///< of what is done with
  std::uint64_t queries = 0;
  std::vector<BoundPiece> open;    ///< what is not
  std::vector<BoundPiece> beyond;  ///< what is known to be too far away
};

/// What decides whether a piece is done with; the same for all of a wave.
struct BoundLimits {
  double near;     ///< distances below are not told apart
  double allowed;  ///< upper bounds up to here are good enough
  double beyond = std::numeric_limits<double>::infinity();  ///< distances at which to give up
};

/// The work of `hausdorff_bounds` in one direction: from a surface to another.
class OneSidedBound {
 public:
  OneSidedBound(const HausdorffSide& from, const HausdorffSide& to, double rounding)
      : mesh_(from.mesh),
        to_mesh_(to.mesh),
        hints_(from.hints),
        lazy_tree_(to.tree),
        rounding_(rounding) {}

  double lower() const { return lower_; }
  /// Of what is done with, and of what is not.
  double upper() const;
  /// Calls `visit` for what is too far away, or may be.
  template <class Visit>
  void visit_beyond(const Visit& visit) const {
    for (const std::vector<BoundPiece>* pieces : {&open_, &beyond_}) {
      for (const BoundPiece& piece : *pieces)
        visit(piece);
    }
  }
  bool has_open() const { return !is_begun_ || !open_.empty(); }
  std::uint64_t queries() const { return queries_; }

  /// Distances of some vertices, for a first guess.
  void probe();
  /// The largest distance of a vertex. Pre: there are hints.
  void find_farthest_vertex(Progress* progress);
  /// Finds vertices that are no farther than that, by hints alone.
  void find_near_vertices(double distance, Progress* progress);
  /// Bounds of all faces by `skim`. Pre: there are hints, and vertices that are near are known.
  void skim_faces(const BoundLimits& limits, Progress* progress);
  /// Distances of all vertices; after `skim_faces`, of those of the faces that are not done with.
  void measure_vertices(const BoundLimits& limits, Progress* progress);
  /// Looks at all faces the first time, later at some of what is open.
  void refine(const BoundLimits& limits, Progress* progress);

 private:
  void note(const BoundOutcome& outcome);
  Face hint(Vertex v, Face otherwise) const;
  bool is_near_hint(const glm::dvec3& p, Face near, double enough) const;
  void begin_faces(const BoundLimits& limits, Progress* progress);
  TriangleTree::Nearest query(const glm::dvec3& p, Face hint, const BoundLimits& limits,
                              BoundOutcome& outcome, double off = 0.0) const;
  double certified(const BoundPiece& piece, double computed) const;
  double bound(const BoundPiece& piece, const Sides& sides, double allowed) const;
  double bound_by_triangles(const BoundPiece& piece, double least) const;
  void split_up(const BoundPiece& piece, int splits, const BoundLimits& limits,
                BoundOutcome& outcome) const;
  BoundPiece piece_of(std::uint32_t face) const;

  const Mesh& mesh_;
  const Mesh& to_mesh_;
  std::span<const Face> hints_;
  LazyTree& lazy_tree_;
  const TriangleTree* to_ = nullptr;  ///< once it is needed
  double rounding_;
  std::optional<std::vector<Skimmed::Unclear>> unclear_;  ///< faces; nothing: all of them
  Array<std::uint8_t> is_near_;  ///< for each vertex: certainly no farther than near_distance_
  double near_distance_ = 0.0;
  Array<double> distance_;  ///< of each vertex, at most
  Array<Face> near_;        ///< and which face is so far away
  std::vector<BoundPiece> open_;
  std::vector<BoundPiece> beyond_;
  double lower_ = 0.0;
  double upper_ = 0.0;
  std::uint64_t queries_ = 0;
  bool is_begun_ = false;
};

}  // namespace mesher
