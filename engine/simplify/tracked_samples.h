#pragma once

#include <cstdint>
#include <vector>

#include "engine/simplify/cost_policy.h"
#include "engine/simplify/error_samples.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// Points of the input that are tracked through the collapses. Each point knows its nearest face,
/// as far as the faces around its collapses tell, and the distance to it. Thus the cost of a
/// collapse is measured against the input and includes everything lost before, which the planes of
/// the current faces forget (H. Hoppe et al., "Mesh optimization", 1993, uses the same energy).
///
/// Invariant: each point that has a face is in the list of that face and in no other; its stored
/// distance is at least the true one.
class TrackedSamples {
 public:
  /// Finds each point's face. O(count valence) expected, parallel. The result does not depend on
  /// the number of threads.
  TrackedSamples(const Surface& surface, const ErrorSamples& samples);

  /// Returns the correction that moves an estimated cost of merging the fan's edge at `p` toward
  /// the cost measured at the points around; the more points, the larger their weight. Never makes
  /// the cost negative. Pre: `fan` is gathered for `h` and its shape is checked there. O(points
  /// around times valence).
  float correction(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p,
                   float estimate);

  /// Applies the collapse for which `correction` was last called.
  void collapsed(const Fan& fan);

 private:
  struct TrackedPoint {
    std::uint32_t next = kNone;  ///< next point of the same face
    float squared_distance = 0.0F;
  };
  struct Moved {
    std::uint32_t sample;
    Face face;
    float squared_distance;
  };

  void find_moved(Face f, const Fan& fan, const glm::vec3& p);

  const ErrorSamples* samples_;
  double weight_ = 0.0;               ///< cost of a point's squared distance
  std::vector<std::uint32_t> first_;  ///< first point of each face
  std::vector<TrackedPoint> points_;  ///< by index of the point
  std::vector<Moved> moved_;          ///< by the collapse last passed to `correction`
  double before_ = 0.0;               ///< sum of the squared distances of `moved_` before it
};

}  // namespace mesher::simplify
