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
#include "engine/simplify/surface.h"

namespace mesher {

/// Whether an error bound is less than half of the mean length of a side of the mesh's faces. O(F).
bool is_fine(const Mesh& mesh, double bound);

/// Keeps the surface within a distance of the input, both ways, collapse by collapse (after
/// R. Klein, G. Liebich, W. Strasser, "Mesh reduction with error control", 1996).
///
/// From the input to the surface: each vertex answers for the input vertices that have become one
/// with it, and its new faces must pass near each of them. From the surface to the input: the new
/// vertex, the middles of its edges and faces must lie near the input, which a walk from face to
/// face finds out, from one that was near before. Where the walk finds none that is near enough, a
/// tree decides; or the collapse is refused if the bound is fine, since then hardly any is near.
/// Between these points the surface may stray by a little more: who promises a bound measures at
/// the end.
class ErrorBound {
 public:
  /// `input`: the mesh before any collapse, with the surface's ids. `shares`: for each vertex which
  /// part of the bound holds where it is; empty: all of it. O(F).
  ErrorBound(const Mesh& input, double bound, Array<float> shares = {});

  /// Whether the edge of the fan may be merged at `p`. O((answered for + 1) valence) expected. For
  /// different regions at once.
  bool allows(const Surface& surface, Vertex removed, Vertex kept, const Fan& fan,
              const glm::vec3& p) const;
  /// `kept`, which went to `p`, answers for what `removed` did. O(1) expected.
  void collapsed(Vertex removed, Vertex kept, const glm::vec3& p);

 private:
  /// Which part of the bound holds for what becomes of an edge.
  double share(Vertex removed, Vertex kept) const {
    return shares_.empty() ? 1.0
                           : double{std::min(shares_[removed.index()], shares_[kept.index()])};
  }
  bool reaches_all(Vertex v, std::span<const std::array<glm::dvec3, 3>> faces, double squared_bound,
                   std::size_t& likely) const;

  /// A face that is likely to be the nearest to a point, or one within the bound.
  struct Near {
    Face face;
    double squared_distance = 0.0;
  };
  Near walk(const glm::dvec3& p, Face from, double squared_bound) const;
  Near with_neighbors(const glm::dvec3& p, Near best, double squared_bound) const;
  Near with_all_around(const glm::dvec3& p, Near best, double squared_bound) const;
  double squared_distance_to(const glm::dvec3& p, Face f) const;

  Mesh input_;
  std::optional<TriangleTree> tree_;
  double squared_bound_;
  Array<std::uint32_t> next_;  ///< around the ring of vertices that one vertex answers for
  Array<float> shares_;        ///< of the bound, of all that a vertex answers for
  Array<Face> near_;  ///< of the input: within the bound of the vertex, or likely to be near
};

}  // namespace mesher
