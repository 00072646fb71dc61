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

namespace mesher::analysis {

/// A triangle that is part of a face.
struct BoundPiece {
  Triangle corners;
  std::array<double, 3> distance;  ///< upper bound for each corner
  std::array<Face, 3> near;        ///< a face of the other surface within that distance
  Face below;                      ///< one near the middle of this piece or of one that contains
                                   ///< it, if known
  double upper = 0.0;              ///< upper bound for all points, if the piece is open
  std::uint8_t cuts = 0;           ///< number of cuts along triangles that produced it
  Face face;                       ///< the face that contains it
};

/// The result of a part of the work.
struct BoundOutcome {
  double lower = 0.0;  ///< the largest distance found
  double upper = 0.0;  ///< upper bound for the settled pieces
  std::uint64_t queries = 0;
  std::vector<BoundPiece> open;    ///< pieces not yet settled
  std::vector<BoundPiece> beyond;  ///< pieces known to be too far away
};

/// The thresholds that settle a piece; the same for all pieces of a wave.
struct BoundLimits {
  double near;     ///< distances below this need not be exact
  double allowed;  ///< upper bounds up to this are sufficient
  double beyond = std::numeric_limits<double>::infinity();  ///< pieces beyond this are not refined
};

/// One direction of `hausdorff_bounds`: from one surface to another.
class OneSidedBound {
 public:
  OneSidedBound(const HausdorffSide& from, const HausdorffSide& to, double rounding)
      : mesh_(from.mesh),
        to_mesh_(to.mesh),
        hints_(from.hints),
        only_(from.only),
        lazy_tree_(to.tree),
        rounding_(rounding) {}

  double lower() const { return lower_; }
  /// Returns the upper bound over settled and open pieces.
  double upper() const;
  /// Calls `visit` for every piece that is, or may be, too far away.
  template <class Visit>
  void visit_beyond(const Visit& visit) const {
    for (const std::vector<BoundPiece>* pieces : {&open_, &beyond_}) {
      for (const BoundPiece& piece : *pieces)
        visit(piece);
    }
  }
  bool has_open() const { return !is_begun_ || !open_.empty(); }
  std::uint64_t queries() const { return queries_; }

  /// Measures some vertices for a first lower bound.
  void probe();
  /// Finds the largest distance of a vertex. Pre: there are hints.
  void find_farthest_vertex(Progress* progress);
  /// Finds vertices within `distance`, using hints only. Looks at no vertex if most faces are
  /// too large for their corners to settle them within `allowed`.
  void find_near_vertices(double distance, double allowed, Progress* progress);
  /// Bounds all faces with `skim`. Pre: there are hints, and one of the two functions above was
  /// called.
  void skim_faces(const BoundLimits& limits, Progress* progress);
  /// Measures all vertices; after `skim_faces`, only those of unsettled faces.
  void measure_vertices(const BoundLimits& limits, Progress* progress);
  /// Processes all faces on the first call, and a wave of open pieces on later calls.
  void refine(const BoundLimits& limits, Progress* progress);

 private:
  void note(const BoundOutcome& outcome);
  Face hint(Vertex v, Face otherwise) const;
  bool is_near_hint(const glm::dvec3& p, Face near, double enough) const;
  std::size_t face_count() const { return only_ ? only_->size() : mesh_.face_count(); }
  Face face(std::size_t i) const {
    return only_ ? (*only_)[i] : Face(static_cast<std::uint32_t>(i));
  }
  bool may_corners_settle(double distance, double allowed) const;
  void begin_faces(const BoundLimits& limits, Progress* progress);
  TriangleTree::Nearest query(const glm::dvec3& p, Face hint, const BoundLimits& limits,
                              BoundOutcome& outcome, double off = 0.0) const;
  double certified(const BoundPiece& piece, double computed) const;
  double bound(const BoundPiece& piece, const Sides& sides, double allowed) const;
  double bound_by_triangles(const BoundPiece& piece, double least) const;
  void split_up(const BoundPiece& piece, int splits, const BoundLimits& limits,
                BoundOutcome& outcome) const;
  BoundPiece piece_of(Face face) const;
  BoundPiece piece_of(Face face, const Triangle& part, const BoundLimits& limits,
                      BoundOutcome& outcome) const;

  const Mesh& mesh_;
  const Mesh& to_mesh_;
  std::span<const Face> hints_;
  std::optional<std::span<const Face>> only_;  ///< as HausdorffSide::only
  LazyTree& lazy_tree_;
  const TriangleTree* to_ = nullptr;  ///< null until it is needed
  double rounding_;
  std::optional<std::vector<Skimmed::Unclear>> unclear_;  ///< unsettled faces; no value: all faces
  Array<std::uint8_t> is_near_;  ///< per vertex: 1 if certainly within near_distance_
  double near_distance_ = 0.0;
  Array<double> distance_;  ///< upper bound for each vertex
  Array<Face> near_;        ///< a face within that distance
  std::vector<BoundPiece> open_;
  std::vector<BoundPiece> beyond_;
  double lower_ = 0.0;
  double upper_ = 0.0;
  std::uint64_t queries_ = 0;
  bool is_begun_ = false;
};

}  // namespace mesher::analysis
