#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/analysis/eight_boxes.h"
#include "engine/analysis/triangle_pair.h"
#include "engine/core/lanes.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// Eight faces of a mesh, one per lane, and a test that settles most pairs of faces at once.
class EightFaces {
 public:
  static constexpr std::size_t kFaces = 8;
  static constexpr bool kLeftUninitialized = true;

  /// Leaves all lanes empty. Call first.
  void clear();
  /// Sets a lane. `is_graph`: from find_graphs. Pre: the face is not removed.
  void set(std::size_t lane, const Mesh& mesh, Face f, std::span<const std::uint8_t> is_graph);

  const EightBoxes& boxes() const { return boxes_; }
  ExactTriangle triangle(std::size_t lane) const;

  /// Returns a bit for each lane whose face may meet face `lane` of `other` in more than shared
  /// corners and sides. Without the bit, they certainly do not: the boxes do not overlap, they
  /// share a vertex whose faces form a graph, or one is on one side of the other's plane. O(1).
  std::uint32_t may_intersect(const EightFaces& other, std::size_t lane) const;

 private:
  Int4 share_graph(std::size_t first, const EightFaces& other, std::size_t lane) const;
  Int4 is_one_sided(std::size_t first, const EightFaces& other, std::size_t lane) const;

  EightBoxes boxes_;
  std::array<std::array<std::uint32_t, kFaces>, 3> graphs_;  ///< corners that are one, or kNone
  std::array<EightPoints, 3> corners_;
  EightPoints normals_;               ///< not of unit length
  std::array<float, kFaces> doubts_;  ///< rounding of a distance from the plane, per unit of
                                      ///< distance from a corner
};

}  // namespace mesher::analysis
