#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/core/array.h"
#include "engine/simplify/attribute_metric.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/quadric.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// What attributes add to the cost of merging an edge at midpoint + y: constant - 2 linear.y + y^T
/// a y, as in EdgeQuadric.
struct AttributeQuadric {
  Quadric<float> a{};  ///< g is not used
  Vec3<float> linear{0.0F, 0.0F, 0.0F};
  float constant = 0.0F;

  float cost(const Vec3<float>& y) const {
    return greater_of(constant - 2.0F * dot(linear, y) + dot(y, a.times(y)), 0.0F);
  }
};

/// The attributes of a mesh under simplification, and how far a collapse changes them.
///
/// An attribute is linear over each face. Where a face's plane is extended to the merged vertex,
/// its attribute has some value there; the vertex gets the mean of these, weighted by area, and the
/// cost is the sum of areas times squared differences from the mean (H. Hoppe, "New quadric metric
/// for simplifying meshes with appearance attributes", 1999; here memoryless, from the current
/// faces). The mean is a linear function of the position, so it is eliminated and a quadric of the
/// position remains.
///
/// Invariants:
///  A1. Corners of a vertex that no feature edge separates share a wedge.
///  A2. The sums of a wedge are those of the faces whose corners have it (within rounding).
class AttributeField {
 public:
  /// Pre: `metric` is that of the surface's mesh, in its units, of size 1 or more. O(F).
  AttributeField(const Surface& surface, const AttributeMetric& metric);

  /// Returns the cost of merging the edge of `h`, if the vertex may be placed anywhere. O(1).
  AttributeQuadric quadric(const Surface& surface, Halfedge h) const;
  /// Returns the cost of merging the edge of `h` into its target, whose attributes stay. O(1).
  float cost_at_target(const Surface& surface, Halfedge h) const;
  /// Same, into its origin.
  float cost_at_origin(const Surface& surface, Halfedge h) const;

  /// Follows a collapse that is about to happen. Regions may do so at once, each for its vertices.
  /// Pre: `fan` is that of `h`. O(valence).
  void collapsing(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p);

  /// Returns the values at a corner, in the order and unit of the metric.
  std::span<const float> at(Halfedge h) const { return {values(wedge_[h.index()]), used_}; }
  /// Returns the wedge of the metric whose values a corner has kept, or kNone.
  std::uint32_t source(Halfedge h) const { return source_[wedge_[h.index()]]; }

  /// What the corners show. Sums are not kept, so only reading is possible after `restore`.
  struct Saved {
    Array<std::uint32_t> wedge;
    Array<float> values;
    Array<std::uint32_t> source;
  };
  Saved save() const { return {wedge_, values_, source_}; }
  void restore(const Saved& saved) {
    wedge_ = saved.wedge;
    values_ = saved.values;
    source_ = saved.source;
  }

 private:
  static constexpr std::size_t kHeader = 8;  ///< area, six of the matrix, one unused
  static constexpr std::size_t kMost = AttributeMetric::kMost;
  using Values = std::array<float, kMost>;
  struct Contribution;

  /// The two wedges at the ends of an edge, on one side of it.
  struct Pair {
    std::uint32_t origin, target;
    friend bool operator==(const Pair&, const Pair&) = default;
  };
  struct Pairs {
    std::array<Pair, 2> pair;
    std::size_t count;
    std::span<const Pair> all() const { return {pair.data(), count}; }
  };

  /// What the wedges of `pairs` become by a collapse.
  struct Merged {
    Pairs pairs;
    std::array<Values, 2> values;
    std::array<std::uint32_t, 2> source{kNone, kNone};
  };
  /// A face, from one of its corners on.
  struct Corners {
    std::array<Vec3<float>, 3> position;
    std::array<std::uint32_t, 3> wedge;
    std::array<const float*, 3> values;
  };

  Pairs pairs(const Mesh& mesh, Halfedge h) const;
  void add(const Pair& pair, const Vec3<float>& half, AttributeQuadric& to) const;
  float moving_cost(std::uint32_t moving, std::uint32_t fixed, const Vec3<float>& y) const;
  void merged_values(const Pair& pair, const Vec3<float>& half, const Vec3<float>& y,
                     Values& to) const;
  Merged merged(const Surface& surface, Halfedge h, const glm::vec3& p) const;
  Corners corners(const Surface& surface, Halfedge h) const;
  void contribute(const Corners& corners, Contribution& to) const;
  void add(std::uint32_t wedge, const Contribution& contribution);
  void subtract(std::uint32_t wedge, const Contribution& contribution);
  void replace(std::uint32_t wedge, const Contribution& before, const Contribution& after);
  void find_wedges(const Surface& surface, const AttributeMetric& metric);
  void find_sums(const Surface& surface);

  float* sums(std::uint32_t wedge) { return &sums_[stride_ * wedge]; }
  const float* sums(std::uint32_t wedge) const { return &sums_[stride_ * wedge]; }
  float* values(std::uint32_t wedge) { return &values_[size_ * wedge]; }
  const float* values(std::uint32_t wedge) const { return &values_[size_ * wedge]; }

  std::size_t size_;  ///< numbers per value, a multiple of four: the last ones may be 0
  std::size_t used_;  ///< of them, those of the metric
  std::size_t stride_;
  Array<std::uint32_t> wedge_;   ///< per half-edge
  Array<float> values_;          ///< size_ per wedge
  Array<std::uint32_t> source_;  ///< per wedge
  /// Per wedge: the sum of areas; of areas times outer products of all gradients; and of areas
  /// times gradients, first the x of all attributes, then y, then z.
  Array<float> sums_;
};

}  // namespace mesher::simplify
