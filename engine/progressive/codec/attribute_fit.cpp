#include "engine/progressive/codec/attribute_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/progressive/codec/split_ring.h"

namespace mesher::progressive {
namespace {

/// Added to the diagonal of the normal equations, relative to their trace. Around a flat vertex
/// they say nothing about the direction of the normal; the gradient is 0 there.
constexpr double kRidge = 1.0 / 4096.0;

}  // namespace

void AttributeFit::fit(std::span<const AttributeLayer> layers, const glm::dvec3& at, Wedge wedge,
                       std::span<const FitSample> samples) {
  at_ = at;
  std::fill(std::begin(matrix_), std::end(matrix_), 0.0);
  spread_ = 0.0;
  for (const FitSample& sample : samples) {
    const glm::dvec3 d = sample.position - at;
    matrix_[0] += d.x * d.x;
    matrix_[1] += d.x * d.y;
    matrix_[2] += d.x * d.z;
    matrix_[3] += d.y * d.y;
    matrix_[4] += d.y * d.z;
    matrix_[5] += d.z * d.z;
  }
  spread_ = matrix_[0] + matrix_[3] + matrix_[5];
  components_.clear();
  product_.clear();
  square_.clear();
  for (const AttributeLayer& layer : layers) {
    const AttributeType& type = layer.type();
    const bool is_linear = type.component == ComponentType::f32 || type.is_normalized;
    const RawValue own = raw_value(type, layer.value(wedge.index()));
    const std::size_t first = components_.size();
    for (std::size_t c = 0; c < type.components; ++c) {
      components_.push_back({.value = own[c]});
      product_.emplace_back(0.0);
      square_.push_back(0.0);
    }
    if (!is_linear || type.kind == AttributeKind::joints) continue;
    for (const FitSample& sample : samples) {
      const RawValue other = raw_value(type, layer.value(sample.wedge.index()));
      const glm::dvec3 d = sample.position - at;
      for (std::size_t c = 0; c < type.components; ++c) {
        const double difference = other[c] - own[c];
        if (!std::isfinite(difference)) continue;
        product_[first + c] += difference * d;
        square_[first + c] += difference * difference;
      }
    }
  }
  solve(samples.size());
}

void AttributeFit::solve(std::size_t samples) {
  if (samples == 0) return;
  const auto count = static_cast<double>(samples);
  if (!(spread_ > 0.0)) {
    for (std::size_t c = 0; c < components_.size(); ++c)
      components_[c].variance = square_[c] / count;
    return;
  }
  const double xx = matrix_[0] / spread_ + kRidge;
  const double xy = matrix_[1] / spread_;
  const double xz = matrix_[2] / spread_;
  const double yy = matrix_[3] / spread_ + kRidge;
  const double yz = matrix_[4] / spread_;
  const double zz = matrix_[5] / spread_ + kRidge;
  const glm::dvec3 first(yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
  const glm::dvec3 second(first.y, xx * zz - xz * xz, xy * xz - xx * yz);
  const glm::dvec3 third(first.z, second.z, xx * yy - xy * xy);
  const double determinant = xx * first.x + xy * first.y + xz * first.z;
  for (std::size_t c = 0; c < components_.size(); ++c) {
    const glm::dvec3 b = product_[c] / spread_;
    const glm::dvec3 g(dot(first, b) / determinant, dot(second, b) / determinant,
                       dot(third, b) / determinant);
    components_[c].gradient = g;
    // The sum of squares about the fit, from the normal equations.
    const double fitted = 2.0 * dot(g, b) - (xx - kRidge) * g.x * g.x - (yy - kRidge) * g.y * g.y -
                          (zz - kRidge) * g.z * g.z -
                          2.0 * (xy * g.x * g.y + xz * g.x * g.z + yz * g.y * g.z);
    const double left = square_[c] / spread_ - fitted;
    components_[c].variance = left > 0.0 ? left * (spread_ / count) : 0.0;
  }
}

void AttributeFit::predict(std::size_t c, const glm::dvec3& position, double& mean,
                           double& variance) const {
  const Component& component = components_[c];
  mean = component.value + dot(component.gradient, position - at_);
  variance = component.variance;
}

}  // namespace mesher::progressive
