#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/simplify/surface.h"

namespace mesher {

/// What all collapses pay, by area, against the mean square distance that is measured in the end:
/// 13.0 to 14.1 on the bunny and the armadillo at 10 and 1 %.
inline constexpr double kTimesCounted = 13.4;

/// Points of the input, spread evenly over its area, by which the distance from the input to the
/// result is measured without a search tree: each point starts at the vertex with which a corner of
/// its face has become one, and walks downhill over the stars of vertices.
class ErrorSamples {
 public:
  /// Draws about `count` points. O(F). Pre: nothing has been collapsed yet.
  ErrorSamples(const Surface& surface, std::size_t count);

  struct Measured {
    double mean_square = 0.0;  ///< of the distance
    /// The variance of the mean square by its square: where a few points carry all of the error, as
    /// on a mostly flat model, it is large and the figure is a guess.
    double uncertainty = 0.0;
  };
  /// The distance of the points to the surface as it is now, in its units; 0 where there are none.
  /// Where a walk ends in a local minimum its distance is too large, which is rare. O(count
  /// valence), parallel, the same for any number of threads.
  Measured measure(const Surface& surface) const;

  struct Nearest {
    Face face;  ///< none where all faces around are gone
    float squared_distance = 0.0F;
  };
  std::size_t size() const { return samples_.size(); }
  const glm::dvec3& point(std::size_t i) const { return samples_[i].point; }
  /// Where the walk of a point ends. O(valence) expected. Pre: i < size().
  Nearest nearest(const Surface& surface, std::size_t i) const;

 private:
  struct Sample {
    glm::dvec3 point;  ///< in double, so that no distance is made of rounding
    Vertex corner;
  };

  Array<Sample> samples_;
};

}  // namespace mesher
