#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "engine/mesh/attributes.h"

namespace mesher::progressive {

/// A face at one end of an edge, as seen from the position of the merged vertex.
struct FaceShare {
  double area = 0.0;
  /// Weights of the differences of the values at the second and third corner from that at the
  /// first: the first value plus these differences is the value at the merged vertex, if the
  /// attribute stays linear beyond the face.
  double second = 0.0;
  double third = 0.0;
  std::array<Wedge, 3> wedges;  ///< of the corners, the end of the edge first
};

/// Returns the share of a face in a vertex at `p`. `corners`: its positions, the end of the edge
/// first. O(1).
FaceShare face_share(const std::array<glm::dvec3, 3>& corners, const std::array<Wedge, 3>& wedges,
                     const glm::dvec3& p);

/// One side of an edge that is merged: the faces at both ends, and the wedges of the ends.
struct MergedSide {
  std::span<const FaceShare> shares;
  Wedge at_child;
  Wedge at_parent;
  /// The nearer of the two, whose values are kept where values may not be blended.
  Wedge nearer;
};

/// Sets the value of a wedge to that of a merged vertex: the mean, weighted by area, of what each
/// face's attribute is there (H. Hoppe, "New quadric metric for simplifying meshes with appearance
/// attributes", 1999). Normals and tangents get unit length, colors stay between 0 and full
/// intensity. What belongs to bones, integers, and values beside absent ones come from the nearer
/// end. `across`: the other side of the edge, or null; values that agree across the edge at both
/// ends still do afterward. O(faces).
void store_merged(const AttributeLayer& from, const MergedSide& side, const MergedSide* across,
                  AttributeLayer& to, std::size_t i);

}  // namespace mesher::progressive
