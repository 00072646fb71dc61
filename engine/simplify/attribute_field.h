#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "engine/core/array.h"
#include "engine/core/prefetch.h"
#include "engine/simplify/attribute_metric.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/four_faces.h"
#include "engine/simplify/quadric.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// What attributes add to the cost of merging an edge at midpoint + y: constant - 2 linear.y + y^T
/// a y, as in EdgeQuadric.
template <class F>
struct AttributeQuadric {
  Quadric<F> a;  ///< g is not used
  Vec3<F> linear;
  F constant;

  F cost(const Vec3<F>& y) const {
    return greater_of(constant - broadcast<F>(2.0F) * dot(linear, y) + dot(y, a.times(y)),
                      broadcast<F>(0.0F));
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
  AttributeQuadric<float> quadric(const Surface& surface, Halfedge h) const;
  /// Returns those of eight edges at once. `half`: half the vectors from origin to target. Pre:
  /// none of them is a feature.
  AttributeQuadric<Float8> quadrics(const std::array<Halfedge, 8>& edges,
                                    const Vec3<Float8>& half) const;
  /// Returns the costs of eight edges whose vertices are merged at the midpoint: those of
  /// `quadrics` at 0. Pre: same.
  Float8 midpoint_costs(const std::array<Halfedge, 8>& edges, const Vec3<Float8>& half) const;
  /// Returns the cost of merging the edge of `h` into its target, whose attributes stay. O(1).
  float cost_at_target(const Surface& surface, Halfedge h) const {
    return cost_at_end(surface, h, true);
  }
  /// Same, into its origin.
  float cost_at_origin(const Surface& surface, Halfedge h) const {
    return cost_at_end(surface, h, false);
  }

  /// Returns at which ends an edge may be merged across seams, as far as wedges decide: two wedges
  /// that become one must get one value. `anywhere`: at both. O(valence).
  AllowedPlacement ends_across(const Mesh& mesh, Halfedge h) const;
  /// Same as cost_at_target and cost_at_origin, across seams at the other end. Wedges there that do
  /// not meet the edge keep their texture where it is: each gets the mean of its faces, extended to
  /// the merged vertex. O(valence).
  float cost_at_end_across(const Surface& surface, Halfedge h, bool is_at_target) const;
  /// Same as `quadric`, across seams at both ends. Pre: ends_across allows both. O(valence).
  AttributeQuadric<float> quadric_across(const Surface& surface, Halfedge h) const;

  /// Returns whether a face would turn over in texture space, or lose its area there. Faces without
  /// area there may. Pre: `fan` is that of `h`. O(valence).
  bool flips_texture(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p) const;
  /// Follows a collapse that is about to happen. Regions may do so at once, each for its vertices.
  /// Pre: `fan` is that of `h`. O(valence).
  void collapsing(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p);

  // See CollapsePolicy.
  void will_need_later(Halfedge h) const { prefetch(&wedge_[h.index()]); }
  void will_need(const Mesh& mesh, Halfedge h) const;
  void will_need(const Fan& fan) const {
    for (const Halfedge spoke : fan.spokes())
      prefetch(&wedge_[spoke.index()]);
  }

  /// Returns the number of values at a corner.
  std::size_t size() const { return size_; }
  /// Appends the values at a corner, in the order and unit of the metric.
  void append_values(Halfedge h, float scale, Array<float>& to) const;
  /// Returns the source wedge of a corner: its index in the metric if the values of the corner are
  /// unchanged, otherwise kNone.
  std::uint32_t source(Halfedge h) const {
    const std::uint32_t source = source_[wedge_[h.index()]];
    return source == kOwn ? own_[h.index()] : source;
  }

  bool has_crossed_seams() const { return has_crossed_seams_.load(std::memory_order_relaxed); }

  /// What the corners show.
  struct Saved {
    Array<std::uint32_t> wedge;
    Array<float> records;
    Array<std::uint32_t> source;
    bool has_crossed_seams = false;
  };
  Saved save() const { return {wedge_, records_, source_, has_crossed_seams()}; }
  void restore(const Saved& saved) {
    wedge_ = saved.wedge;
    records_ = saved.records;
    source_ = saved.source;
    has_crossed_seams_.store(saved.has_crossed_seams, std::memory_order_relaxed);
  }

 private:
  /// The source of a wedge that no collapse has touched and whose corners have different ones.
  static constexpr std::uint32_t kOwn = kNone - 1;
  static constexpr std::size_t kMost = AttributeMetric::kMost;
  static constexpr std::size_t kFloatsPerLine = 16;  ///< of the cache
  using Values = std::array<float, kMost>;

  /// The two wedges at the ends of an edge, on one side of it.
  struct Pair {
    std::uint32_t origin, target;
    friend bool operator==(const Pair&, const Pair&) = default;
  };
  /// One, or two at a feature edge.
  struct Pairs {
    std::array<Pair, 2> pair;
    std::size_t count;
    std::span<const Pair> all() const { return {pair.data(), count}; }
  };
  struct Merged;
  /// Wedges at an end of an edge that are not at the edge itself.
  static constexpr std::size_t kMostAside = 8;
  struct Aside {
    std::array<std::uint32_t, kMostAside> wedge;
    std::size_t count = 0;
    bool is_complete = true;
    std::span<const std::uint32_t> all() const { return {wedge.data(), count}; }
  };

  Aside aside(const Mesh& mesh, Vertex v, const Pairs& pairs) const;
  Pairs pairs(const Mesh& mesh, Halfedge h) const;
  std::array<std::array<Pair, 4>, 2> pairs(const std::array<Halfedge, 8>& edges) const;
  /// What is computed of a quadric.
  enum class Part { all, constant };
  template <Part kPart>
  AttributeQuadric<Float4> quadrics(const std::array<Pair, 4>& pairs,
                                    const Vec3<Float4>& half) const;
  float cost_at_end(const Surface& surface, Halfedge h, bool is_at_target) const;
  float moving_cost(std::uint32_t moving, std::uint32_t fixed, const Vec3<float>& y) const;
  void merged_values(const Pair& pair, const Vec3<float>& half, const Vec3<float>& y,
                     Values& to) const;
  Merged merged(const Surface& surface, Halfedge h, const glm::vec3& p) const;
  void keep_equal(Merged& merged) const;
  Quadric<float> extension(std::uint32_t wedge) const;
  void extend_aside(const Surface& surface, Halfedge h, bool is_target, const glm::vec3& p,
                    Merged& merged) const;
  bool differ_in_texture_only(std::uint32_t a, std::uint32_t b) const;
  FourWedges wedges(const FourHalfedges& from) const;
  Float4 values(Int4 wedges, std::size_t j) const;
  void load(const Surface& surface, const FourHalfedges& from, FourFaces& to) const;
  void clear(std::uint32_t wedge);
  void remove_faces_at(const Surface& surface, Halfedge h);
  void find_wedges(const Surface& surface, const AttributeMetric& metric);
  void find_sums(const Surface& surface);

  void will_need(std::uint32_t wedge) const {
    const float* const first = record(wedge);
    for (std::size_t k = 0; k < stride_; k += kFloatsPerLine)
      prefetch(first + k);
    prefetch(first + stride_ - 1);
  }

  // A record has four floats per row: the sum of areas, and of areas times outer products of all
  // gradients (xx, xy, xz; yy, yz, zz, and one unused); then for each attribute the sum of areas
  // times gradients, and the value.
  float* record(std::uint32_t wedge) { return &records_[stride_ * wedge]; }
  const float* record(std::uint32_t wedge) const { return &records_[stride_ * wedge]; }
  static std::size_t row(std::size_t attribute) { return 8 + 4 * attribute; }
  float value(std::uint32_t wedge, std::size_t j) const { return record(wedge)[row(j) + 3]; }

  std::atomic<bool> has_crossed_seams_{false};
  std::size_t size_;
  std::size_t stride_;
  std::vector<std::size_t> texcoords_;  ///< first of two numbers each
  std::array<bool, kMost> is_texcoord_{};
  Array<std::uint32_t> wedge_;   ///< per half-edge
  Array<float> records_;         ///< per wedge
  Array<std::uint32_t> source_;  ///< per wedge: that of its corners, kNone or kOwn
  Array<std::uint32_t> own_;     ///< per half-edge: its wedge in the metric; empty if never kOwn
};

}  // namespace mesher::simplify
