#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>

#include "engine/core/lanes.h"
#include "engine/mesh/statistics.h"

namespace mesher::analysis {

/// Eight points, one per lane.
struct EightPoints {
  std::array<float, 8> x, y, z;

  /// Returns the points in four lanes.
  Vec3<Float4> load(std::size_t first) const {
    return {load4(&x[first]), load4(&y[first]), load4(&z[first])};
  }
  glm::vec3 get(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
  void set(std::size_t lane, const glm::vec3& p) {
    x[lane] = p.x;
    y[lane] = p.y;
    z[lane] = p.z;
  }
};

inline Vec3<Float4> in_four_lanes(const glm::vec3& p) {
  return {broadcast<Float4>(p.x), broadcast<Float4>(p.y), broadcast<Float4>(p.z)};
}

/// Eight boxes, one per lane.
class EightBoxes {
 public:
  static constexpr bool kLeftUninitialized = true;

  /// Leaves all lanes empty: they overlap nothing. Call first.
  void clear() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    all_ = {glm::vec3(kInfinity), glm::vec3(-kInfinity)};
    for (std::size_t lane = 0; lane < 8; ++lane) {
      min_.set(lane, all_.min);
      max_.set(lane, all_.max);
    }
  }
  /// Sets an empty lane.
  void set(std::size_t lane, const Box& box) {
    min_.set(lane, box.min);
    max_.set(lane, box.max);
    all_ = {glm::min(all_.min, box.min), glm::max(all_.max, box.max)};
  }
  Box get(std::size_t lane) const { return {min_.get(lane), max_.get(lane)}; }
  /// Bounds all boxes.
  const Box& all() const { return all_; }

  /// Returns a bit for each lane whose box overlaps `box`, touches included. O(1).
  std::uint32_t overlapping(const Box& box) const {
    const Vec3<Float4> min = in_four_lanes(box.min);
    const Vec3<Float4> max = in_four_lanes(box.max);
    return overlapping(0, min, max) | overlapping(4, min, max) << 4U;
  }

 private:
  std::uint32_t overlapping(std::size_t first, const Vec3<Float4>& min,
                            const Vec3<Float4>& max) const {
    const Vec3<Float4> least = min_.load(first);
    const Vec3<Float4> most = max_.load(first);
    return bits_of((least.x <= max.x) & (min.x <= most.x) & (least.y <= max.y) & (min.y <= most.y) &
                   (least.z <= max.z) & (min.z <= most.z));
  }

  EightPoints min_;
  EightPoints max_;
  Box all_;
};

}  // namespace mesher::analysis
