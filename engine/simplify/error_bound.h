#pragma once

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "engine/analysis/triangle_tree.h"
#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// Returns whether a bound is less than half the mean edge length of the mesh. O(F).
bool is_fine(const Mesh& mesh, double bound);

/// Keeps the surface within a distance of the input, in both directions, at every collapse (after
/// R. Klein, G. Liebich, W. Strasser, "Mesh reduction with error control", 1996).
///
/// From input to surface: each vertex represents the input vertices merged into it, and its new
/// faces must pass within the bound of each of them. From surface to input: the new vertex and the
/// midpoints of its edges and faces must lie within the bound of the input. A walk from face to
/// face checks this, starting where the vertex was in the input. If the walk finds no face within
/// the bound, a tree decides; if the bound is fine, the collapse is refused instead, because a near
/// face is then unlikely. Between these points the surface may exceed the bound slightly, so a
/// certified bound has to be measured at the end.
///
/// Most collapses stay far below the bound. An estimate shows this in a fraction of the time: the
/// largest height of the two old vertices above the planes of the new faces, plus the larger
/// estimate of the two vertices. Only if it is not clearly below the bound are points checked.
class ErrorBound {
 public:
  /// `input`: the mesh before any collapse, with the surface's ids. `shares`: the fraction of the
  /// bound that applies at each vertex; empty: all of it. O(F).
  ErrorBound(const Mesh& input, double bound, Array<float> shares = {});

  /// Returns the estimated distance from the input of the surface around the merged vertex at `p`.
  /// Pre: `fan` is gathered for `h` and its shape is checked at `p`. O(valence).
  float estimate(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p) const;
  /// Returns whether the edge of `h` may be merged at `p`, where `estimate` is the estimated
  /// distance. Thread-safe for different regions. Expected O((represented vertices + 1) valence) if
  /// points are checked. Pre: as for `estimate`.
  bool allows(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p,
              float estimate) const;
  /// Same, for a step of an earlier run. Looks at positions only, not at shapes. Pre: `fan` is
  /// gathered for its edge.
  bool allows_again(const Surface& surface, const Fan& fan, const CollapseStep& step) const;
  /// Returns whether heights above planes show all that a collapse changes: neither a boundary that
  /// moves in its plane nor a face that turns over. Pre: as for `estimate`.
  static bool covers_all(const Fan& fan) { return fan.is_closed() && fan.turned_area() == 0.0F; }
  /// Records a collapse: its vertex also represents the vertices of the removed one. O(1).
  void collapsed(const CollapseStep& step);
  /// Stops trusting estimates: from now on, points are always checked. For the last collapses,
  /// which are few and large.
  void distrust_estimates() { trusted_ = 0.0; }
  /// Returns whether less than the whole bound applies at a vertex.
  bool is_tight(Vertex v) const { return !shares_.empty() && shares_[v.index()] < 1.0F; }

  /// What collapses change.
  struct Saved {
    Array<std::uint32_t> next;
    Array<float> shares;
    Array<float> estimates;
    double trusted = 0.0;
  };
  Saved save() const { return {next_, shares_, estimates_, trusted_}; }
  void restore(const Saved& saved) {
    next_ = saved.next;
    shares_ = saved.shares;
    estimates_ = saved.estimates;
    trusted_ = saved.trusted;
  }

 private:
  /// Returns the fraction of the bound that applies to the merged vertex.
  double share(Vertex removed, Vertex kept) const {
    return shares_.empty() ? 1.0
                           : double{std::min(shares_[removed.index()], shares_[kept.index()])};
  }
  bool is_within(double squared_bound, const Surface& surface, Halfedge h, const Fan& fan,
                 const glm::vec3& p) const;
  bool reaches_all(Vertex v, std::span<const std::array<glm::dvec3, 3>> faces, double squared_bound,
                   std::size_t& likely) const;

  /// The face probably nearest to a point, or one within the bound.
  struct Near {
    Face face;
    double squared_distance = 0.0;
  };
  Near walk(const glm::dvec3& p, Face from, double squared_bound) const;
  Near with_neighbors(const glm::dvec3& p, Near best, double squared_bound) const;
  Near with_all_around(const glm::dvec3& p, Near best, double squared_bound) const;
  double squared_distance_to(const glm::dvec3& p, Face f) const;

  Mesh input_;
  std::optional<analysis::TriangleTree> tree_;
  double bound_;
  double trusted_ = 0.0;       ///< multiple of the bound up to which an estimate is trusted
  Array<std::uint32_t> next_;  ///< circular list of the input vertices that a vertex represents
  Array<float> shares_;        ///< fraction of the bound, lowest over the vertices represented
  Array<float> estimates_;     ///< of the distance from the input, by vertex
};

}  // namespace mesher::simplify
