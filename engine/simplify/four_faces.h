#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/core/lanes.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/attribute_metric.h"

namespace mesher::simplify {

/// A corner of each of four faces.
using FourHalfedges = std::array<Halfedge, 4>;
/// The wedges at the corners of four faces: per corner, a lane per face.
using FourWedges = std::array<Int4, 3>;

/// Four faces, each from one of its corners on, and the attributes at the corners.
struct FourFaces {
  FourWedges wedge;
  std::array<Vec3<Float4>, 3> position;                              ///< per corner
  std::array<std::array<Float4, AttributeMetric::kMost>, 3> values;  ///< per corner

  std::uint32_t wedge_at(std::size_t corner, std::size_t face) const {
    return static_cast<std::uint32_t>(wedge[corner][face]);
  }
};

/// What four faces add to the records of wedges at their corners: areas, and areas times gradients
/// and their outer products. AttributeField tells how a record is laid out.
class FourContributions {
 public:
  /// Computes them for attributes of `size` numbers. O(size).
  void set(const FourFaces& faces, std::size_t size);

  /// Returns a row of the record for one of the faces.
  Float4 row(std::size_t row, std::size_t face) const { return rows_[4 * row + face]; }

 private:
  std::array<Float4, 4 * (2 + AttributeMetric::kMost)> rows_;
};

}  // namespace mesher::simplify
