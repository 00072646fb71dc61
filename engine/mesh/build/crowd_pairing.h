#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/mesh/mesh.h"

namespace mesher {

/// Pairs the half-edges of a crowd, an edge of three or more faces, so that solids which touch
/// along the edge are separated whole. Internal to building.
///
/// Faces are sorted by angle around the edge, from its lower to its upper vertex. The inside of a
/// face is the side that its normal points away from. It lies toward lower angles if the half-edge
/// runs up, and toward higher angles if it runs down. So a "down" face and the next "up" face bound
/// a wedge of solid. They are paired like brackets.
class CrowdPairing {
 public:
  explicit CrowdPairing(MeshArrays& mesh) : mesh_(mesh) {}

  /// Writes the twins of the half-edges of one crowd, and no others. A half-edge that finds no
  /// partner keeps none. O(k log k) for k faces. Pre: none of them has a twin.
  void run(std::span<const std::uint32_t> crowd);

 private:
  void sort_by_angle(std::span<const std::uint32_t> crowd);
  Vertex origin(std::uint32_t h) const { return mesh_.origin[h]; }
  Vertex target(std::uint32_t h) const { return mesh_.origin[Mesh::next(Halfedge(h)).index()]; }

  MeshArrays& mesh_;
  std::vector<std::pair<double, std::uint32_t>> by_angle_;
  std::vector<std::uint32_t> open_;  ///< "down" half-edges without a partner so far
};

}  // namespace mesher
