#pragma once

#include <cstdint>
#include <vector>

#include "engine/simplify/cost_policy.h"
#include "engine/simplify/error_samples.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/surface.h"

namespace mesher {

/// Points of the input that are followed through the collapses: each knows the face that is nearest
/// to it, as far as the faces around its collapses tell, and how far that is. So the cost of a
/// collapse can be measured against the input, with all that was lost before: planes as they are
/// now forget it (H. Hoppe et al., "Mesh optimization", 1993, has the same energy).
///
/// Invariant: each point that has a face is in the list of that face, and in no other; its distance
/// is at least the true one.
class TrackedSamples {
 public:
  /// Finds each point's face. O(count valence) expected, parallel; the same for any number of
  /// threads.
  TrackedSamples(const Surface& surface, const ErrorSamples& samples);

  /// What to add to the cost of merging the edge of the fan at the candidate's position, so that it
  /// becomes what the points around say: as much of it as there are points to say so. Never makes
  /// the cost negative. O(points around times valence). Pre: `fan` is gathered for `h` and its
  /// shape is checked there.
  float correction(const Surface& surface, Halfedge h, const Fan& fan, const Candidate& candidate);

  /// Follows the collapse that `correction` was last asked about.
  void collapsed(const Fan& fan);

 private:
  struct TrackedPoint {
    std::uint32_t next = kNone;  ///< of the same face
    float squared_distance = 0.0F;
  };
  struct Moved {
    std::uint32_t sample;
    Face face;
    float squared_distance;
  };

  void find_moved(Face f, const Fan& fan, const glm::vec3& p);

  const ErrorSamples& samples_;
  double weight_ = 0.0;               ///< of a point: the cost of its squared distance
  std::vector<std::uint32_t> first_;  ///< point of each face
  std::vector<TrackedPoint> points_;  ///< of the points
  std::vector<Moved> moved_;          ///< by the collapse that was last asked about
  double before_ = 0.0;               ///< the squared distances of those, summed
};

}  // namespace mesher
