#include "engine/analysis/uv_stretch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/analysis/sample_values.h"
#include "engine/analysis/uv_frame.h"

namespace mesher::analysis {
namespace {

constexpr double kNoStretch = std::numeric_limits<double>::infinity();

/// Squares of the two figures of UvStretch.
struct SquaredStretch {
  double mean = kNoStretch;
  double worst = kNoStretch;
};

/// Returns the stretch from one metric to another. The squared singular values of the map between
/// the triangles are the eigenvalues of the one metric's inverse times the other.
SquaredStretch squared_stretch(const UvMetric& original, const UvMetric& metric) {
  const double determinant = original.determinant();
  if (!(determinant > 0.0)) return {};
  const double trace =
      (original.vv * metric.uu - 2.0 * original.uv * metric.uv + original.uu * metric.vv) /
      determinant;
  const double product = metric.determinant() / determinant;
  const double root = std::sqrt(std::max(0.25 * trace * trace - product, 0.0));
  return {0.5 * trace, 0.5 * trace + root};
}

}  // namespace

UvStretch uv_stretch(const AttributedSurface& original, const AttributedSurface& to,
                     const SurfaceMatches& matches) {
  const UvLayers uvs_of_original(original);
  const UvLayers uvs(to);
  const auto stretch_at = [&](std::size_t i) -> SquaredStretch {
    const SurfacePoint& sample = matches.sample(i);
    const auto uv = uvs.corners(sample.face);
    if (!uv) return {};
    const auto metric = uv_metric(corners_of(to.mesh, sample.face), *uv);
    if (!metric) return {};
    // On a seam, the side that the sample is on.
    SquaredStretch stretch;
    double least = kNoStretch;
    for (const SurfacePoint& candidate : matches.candidates(i)) {
      const auto other = uvs_of_original.corners(candidate.face);
      if (!other) continue;
      const double slide = glm::length(*uvs_of_original.at(candidate) - *uvs.at(sample));
      const auto base = uv_metric(corners_of(original.mesh, candidate.face), *other);
      if (!base || !(slide < least)) continue;
      least = slide;
      stretch = squared_stretch(*base, *metric);
    }
    return stretch;
  };
  const auto mean = [&](std::size_t i) { return std::sqrt(stretch_at(i).mean); };
  const auto worst = [&](std::size_t i) { return std::sqrt(stretch_at(i).worst); };
  return {.mean = Spread(values_at_samples(matches.count(), mean)),
          .worst = Spread(values_at_samples(matches.count(), worst))};
}

}  // namespace mesher::analysis
