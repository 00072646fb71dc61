#include "engine/analysis/texture_deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/analysis/sample_values.h"

namespace mesher::analysis {

TextureDeviation texture_deviation(const AttributedSurface& from, const UvTree& to,
                                   const SurfaceMatches& samples) {
  constexpr double kNoTexture = std::numeric_limits<double>::quiet_NaN();
  const UvLayers uvs(from);
  std::vector<float> values = values_at_samples(samples.count(), [&](std::size_t i) {
    const std::optional<glm::dvec2> uv = uvs.at(samples.sample(i));
    if (!uv) return kNoTexture;
    return std::sqrt(to.squared_distance(*uv, position_of(from.mesh, samples.sample(i))));
  });
  TextureDeviation deviation;
  const std::size_t textured = static_cast<std::size_t>(
      std::ranges::count_if(values, [](float value) { return !std::isnan(value); }));
  deviation.distances = Spread(std::move(values));
  if (textured > 0) {
    deviation.covered =
        static_cast<double>(deviation.distances.count()) / static_cast<double>(textured);
  }
  return deviation;
}

}  // namespace mesher::analysis
