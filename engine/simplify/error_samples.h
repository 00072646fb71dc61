#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// Ratio of the paid costs per area to the mean square distance measured at the end: 13.0 to 14.1
/// on the bunny and the armadillo at 10 and 1 %.
inline constexpr double kTimesCounted = 13.4;

/// Points of the input, spread evenly over its area, for measuring the distance from the input to
/// the result without a search tree. Each point starts at the vertex into which a corner of its
/// face was merged, and walks downhill over vertex stars.
class ErrorSamples {
 public:
  /// Samples about `count` points. O(F). Pre: nothing has been collapsed yet.
  ErrorSamples(const Surface& surface, std::size_t count);

  struct Measured {
    double mean_square = 0.0;  ///< of the distance
    /// Variance of `mean_square` divided by its square. Large if a few points carry all of the
    /// error, as on a mostly flat model; the estimate is then unreliable.
    double uncertainty = 0.0;
  };
  /// Returns the distance of the points to the current surface, in its units; 0 if there are no
  /// points. A walk that ends in a local minimum overestimates the distance; this is rare. O(count
  /// valence), parallel. The result does not depend on the number of threads.
  Measured measure(const Surface& surface) const;

  struct Nearest {
    Face face;  ///< none if all faces around are removed
    float squared_distance = 0.0F;
  };
  std::size_t size() const { return samples_.size(); }
  const glm::dvec3& point(std::size_t i) const { return samples_[i].point; }
  /// Returns the face at which a point's walk ends. O(valence) expected. Pre: i < size().
  Nearest nearest(const Surface& surface, std::size_t i) const;

 private:
  struct Sample {
    glm::dvec3 point;  ///< double, so that rounding does not show up as distance
    Vertex corner;
  };

  Array<Sample> samples_;
};

}  // namespace mesher::simplify
