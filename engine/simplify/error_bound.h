#pragma once

#include <glm/vec3.hpp>

#include "engine/analysis/triangle_tree.h"
#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/surface.h"

namespace mesher {

/// Keeps the surface within a distance of the input, both ways, collapse by collapse (after
/// R. Klein, G. Liebich, W. Strasser, "Mesh reduction with error control", 1996).
///
/// From the input to the surface: each vertex answers for the input vertices that have become one
/// with it, and its new faces must pass near each of them. From the surface to the input: the new
/// vertex, the middles of its edges and faces must lie near the input, by exact distance over a
/// tree. Between these points the surface may stray by a little more: who promises a bound measures
/// at the end.
class ErrorBound {
 public:
  /// `input`: the mesh before any collapse, with the surface's ids. O(F log F).
  ErrorBound(const Mesh& input, double bound);

  /// Whether the edge of the fan may be merged at `p`. O((answered for + 1) valence + valence log
  /// F) expected. For different regions at once.
  bool allows(const Surface& surface, Vertex removed, Vertex kept, const Fan& fan,
              const glm::vec3& p) const;
  /// `kept` answers for what `removed` did. O(1).
  void collapsed(Vertex removed, Vertex kept);

 private:
  bool is_near_input(const glm::dvec3& p) const;
  bool reaches_all(const Mesh& mesh, Vertex v, const Fan& fan, const glm::dvec3& center) const;

  TriangleTree tree_;
  double squared_bound_;
  Array<glm::vec3> input_;     ///< positions
  Array<std::uint32_t> next_;  ///< the next that is answered for by the same vertex; around
};

}  // namespace mesher
