#include "engine/analysis/uv_slide.h"

#include <glm/geometric.hpp>
#include <limits>

#include "engine/analysis/sample_values.h"

namespace mesher::analysis {

Spread uv_slide(const AttributedSurface& from, const AttributedSurface& to,
                const SurfaceMatches& matches, Reference reference) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const UvLayers here(from);
  const UvLayers there(to);
  return Spread(values_at_samples(matches.count(), [&](std::size_t i) {
    const SurfacePoint& sample = matches.sample(i);
    const std::optional<glm::dvec2> uv = here.at(sample);
    if (!uv) return kNone;
    return least_difference(matches, i, [&](const SurfacePoint& candidate) {
      const std::optional<glm::dvec2> other = there.at(candidate);
      if (!other) return kNone;
      const FaceTexture texture =
          reference == Reference::from ? from.texture(sample.face) : to.texture(candidate.face);
      return glm::length(texture.texels * (*uv - *other));
    });
  }));
}

}  // namespace mesher::analysis
