#include "engine/analysis/attributed_surface.h"

#include <algorithm>
#include <cmath>

namespace mesher::analysis {

FaceTexture AttributedSurface::texture(Face f) const {
  if (textures.empty() || attributes.group.empty()) return {};
  return textures[attributes.group[f.index()]];
}

AttributeValue SurfaceLayer::at(Halfedge corner) const {
  return load(layer_, surface_.attributes.wedge(surface_.mesh.origins(), corner).index());
}

AttributeValue SurfaceLayer::at(const SurfacePoint& point) const {
  AttributeValue sum{};
  for (std::uint32_t c = 0; c < 3; ++c) {
    // A corner that does not count may have no value.
    if (point.weights[static_cast<int>(c)] == 0.0F) continue;
    const AttributeValue value = at(Mesh::halfedge(point.face, c));
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += double{point.weights[static_cast<int>(c)]} * value[i];
  }
  return sum;
}

UvLayers::UvLayers(const AttributedSurface& surface) : surface_(surface) {
  for (std::uint32_t set = 0; set < kSets; ++set) {
    const AttributeLayer* const layer = surface.attributes.find(texcoord_type(set).name);
    if (layer != nullptr && layer->type().components >= 2) layers_[set] = layer;
  }
}

bool UvLayers::is_empty() const {
  return std::ranges::all_of(layers_, [](const AttributeLayer* layer) { return layer == nullptr; });
}

std::optional<std::array<glm::dvec2, 3>> UvLayers::corners(Face f) const {
  const std::uint32_t set = surface_.texture(f).set;
  const AttributeLayer* const layer = set < kSets ? layers_[set] : nullptr;
  if (layer == nullptr) return std::nullopt;
  const SurfaceLayer values(surface_, *layer);
  std::array<glm::dvec2, 3> uv{};
  for (std::uint32_t c = 0; c < 3; ++c) {
    const AttributeValue value = values.at(Mesh::halfedge(f, c));
    uv[c] = {value[0], layer->type().counts_down ? value[1] : 1.0 - value[1]};
    if (!std::isfinite(uv[c].x) || !std::isfinite(uv[c].y)) return std::nullopt;
  }
  return uv;
}

std::optional<glm::dvec2> UvLayers::at(const SurfacePoint& point) const {
  const auto uv = corners(point.face);
  if (!uv) return std::nullopt;
  const glm::dvec3 w(point.weights);
  return w.x * (*uv)[0] + w.y * (*uv)[1] + w.z * (*uv)[2];
}

}  // namespace mesher::analysis
