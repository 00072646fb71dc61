#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/codec/layer_format.h"

namespace mesher::progressive {

/// A vertex beside the parent of a split, on the faces of one of its wedges.
struct FitSample {
  glm::dvec3 position;
  Wedge wedge;
};

/// The linear function of the position that fits the values around a vertex best. It goes through
/// the vertex itself. Attributes are nearly linear over a few faces, so it says what the values of
/// the vertices after a split are.
class AttributeFit {
 public:
  /// Fits all layers. O(samples * components). Pre: the wedges exist.
  void fit(std::span<const AttributeLayer> layers, const glm::dvec3& at, Wedge wedge,
           std::span<const FitSample> samples);

  /// Sets mean and variance of component `c` (counted over all layers) at a position.
  void predict(std::size_t c, const glm::dvec3& position, double& mean, double& variance) const;
  /// Notes by how much a value, that of the child, differs from its prediction. The merged value
  /// lies between those of the two ends, so the other end differs in the other direction.
  void note(std::size_t c, double difference) { components_[c].difference = difference; }
  double noted(std::size_t c) const { return components_[c].difference; }

 private:
  struct Component {
    double value = 0.0;
    glm::dvec3 gradient{0.0};
    double variance = 0.0;  ///< of the samples about the fit
    double difference = 0.0;
  };

  void solve(std::size_t samples);

  glm::dvec3 at_{0.0};
  double spread_ = 0.0;    ///< sum of the squared distances of the samples
  double matrix_[6] = {};  ///< sums of xx, xy, xz, yy, yz, zz
  std::vector<Component> components_;
  std::vector<glm::dvec3> product_;  ///< by component: sum of offset * difference of the value
  std::vector<double> square_;       ///< by component: sum of squared differences of the value
};

}  // namespace mesher::progressive
