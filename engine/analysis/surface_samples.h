#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// Sample points that are spread evenly over the area of a mesh. Their positions are fixed: the
/// same mesh gives the same samples. Each face has the samples whose position along the cumulative
/// area falls into it. The samples of face f are those from `begin(f)` to `begin(f + 1)`.
class SurfaceSamples {
 public:
  /// O(F). `count` samples, or none if the mesh has no area; the mesh must outlive this object.
  SurfaceSamples(const Mesh& mesh, std::uint64_t count);

  std::uint64_t begin(std::size_t face) const {
    return static_cast<std::uint64_t>(area_before_[face] * per_area_);
  }
  std::uint64_t count() const { return begin(area_before_.size() - 1); }

  /// Returns the barycentric weights of a sample.
  static glm::dvec3 weights(std::uint64_t sample);
  /// Returns the position of a sample of a face.
  glm::dvec3 position(std::size_t face, std::uint64_t sample) const;

 private:
  const Mesh& mesh_;
  std::vector<double> area_before_;  ///< total area of the faces before each; F + 1 entries
  double per_area_ = 0.0;
};

}  // namespace mesher::analysis
