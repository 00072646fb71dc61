#include "engine/simplify/attribute_metric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "engine/analysis/surface_point.h"
#include "engine/core/parallel.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/joint_places.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kMetricGrain = std::size_t{1} << 12;
// A difference of 1 in normals or colors, as a share of the diagonal.
constexpr double kShareOfDiagonal = 0.01;
constexpr std::size_t kSizeOfPlace = 3;

/// Returns the length on the surface that one unit of the texture coordinates covers on average; 0
/// if they cover nothing.
double length_per_unit(const Mesh& mesh, const Attributes& attributes,
                       const AttributeLayer& layer) {
  struct Areas {
    double surface = 0.0;
    double texture = 0.0;
    Areas& operator+=(const Areas& other) {
      surface += other.surface;
      texture += other.texture;
      return *this;
    }
  };
  const auto areas = parallel_sum<Areas>(mesh.face_count(), kMetricGrain, [&](IndexRange range) {
    Areas sum;
    for (std::size_t f = range.begin; f < range.end; ++f) {
      const Face face(static_cast<std::uint32_t>(f));
      const std::array<glm::dvec3, 3> p = analysis::corners_of(mesh, face);
      glm::dvec2 uv[3];
      for (std::uint32_t c = 0; c < 3; ++c) {
        const Halfedge h = Mesh::halfedge(face, c);
        const AttributeValue value = load(layer, attributes.wedge(mesh.origins(), h).index());
        uv[c] = {value[0], value[1]};
      }
      const glm::dvec2 a = uv[1] - uv[0];
      const glm::dvec2 b = uv[2] - uv[0];
      const double texture = 0.5 * std::abs(a.x * b.y - a.y * b.x);
      if (!std::isfinite(texture)) continue;
      sum.surface += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
      sum.texture += texture;
    }
    return sum;
  });
  return areas.texture > 0.0 ? std::sqrt(areas.surface / areas.texture) : 0.0;
}

bool has_absent(const AttributeLayer& layer) {
  for (std::size_t i = 0; i < layer.count(); ++i) {
    if (is_absent(layer, i)) return true;
  }
  return false;
}

/// Returns the factor from a layer's values to lengths; 0 if it does not count. `unit`: the length
/// that a difference of 1 in normals or colors counts as.
double factor_of(const Mesh& mesh, const Attributes& attributes, const AttributeLayer& layer,
                 const AttributeWeights& weights, double unit) {
  if (!can_blend(layer.type()) || has_absent(layer)) return 0.0;
  switch (layer.type().kind) {
    case AttributeKind::texcoord:
      return double{weights.texcoord} * length_per_unit(mesh, attributes, layer);
    case AttributeKind::normal:
      return double{weights.normal} * unit;
    case AttributeKind::color:
      return double{weights.color} * unit;
    case AttributeKind::tangent:
    case AttributeKind::joints:
    case AttributeKind::weights:
    case AttributeKind::delta:
    case AttributeKind::custom:
      break;
  }
  return 0.0;
}

/// Chooses the layers and their factors.
void choose_layers(const Mesh& mesh, const Attributes& attributes, const AttributeWeights& weights,
                   AttributeMetric& metric) {
  const double unit = kShareOfDiagonal * bounding_box(mesh).diagonal();
  for (std::size_t i = 0; i < attributes.layers.size(); ++i) {
    const AttributeLayer& layer = attributes.layers[i];
    const double factor = factor_of(mesh, attributes, layer, weights, unit);
    const std::size_t size = metric.size + layer.type().components;
    if (!(factor > 0.0) || !std::isfinite(factor) || size > AttributeMetric::kMost) continue;
    metric.layers.push_back({i, factor, metric.size, layer.type().kind == AttributeKind::texcoord});
    metric.size = size;
  }
}

}  // namespace

AttributeMetric attribute_metric(const Mesh& mesh, const Attributes& attributes,
                                 const AttributeWeights& weights) {
  AttributeMetric metric;
  choose_layers(mesh, attributes, weights, metric);
  std::vector<glm::dvec3> joints;
  if (weights.joint > 0.0F && metric.size + kSizeOfPlace <= AttributeMetric::kMost) {
    joints = joint_places(mesh, attributes);
    if (!joints.empty()) metric.size += kSizeOfPlace;
  }
  if (metric.size == 0) return metric;
  const std::size_t wedges = attributes.layers.front().count();
  metric.values.resize(metric.size * wedges);
  parallel_for(wedges, kMetricGrain, [&](IndexRange range) {
    for (std::size_t w = range.begin; w < range.end; ++w) {
      float* to = &metric.values[metric.size * w];
      for (const AttributeMetric::Layer& counted : metric.layers) {
        const AttributeLayer& layer = attributes.layers[counted.index];
        const AttributeValue value = load(layer, w);
        for (std::size_t k = 0; k < layer.type().components; ++k) {
          const auto x = static_cast<float>(counted.factor * value[k]);
          *to++ = std::isfinite(x) ? x : 0.0F;
        }
      }
      if (joints.empty()) continue;
      for (int k = 0; k < 3; ++k)
        *to++ = static_cast<float>(double{weights.joint} * joints[w][k]);
    }
  });
  metric.of_corner.resize(mesh.halfedge_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    metric.of_corner[h] = attributes.wedge(mesh.origins(), Halfedge(h)).index();
  return metric;
}

AttributeMetric of_faces(const AttributeMetric& metric, std::span<const Face> face_source,
                         float scale) {
  AttributeMetric result{.size = metric.size, .layers = metric.layers, .values = metric.values};
  for (float& x : result.values)
    x *= scale;
  result.of_corner.resize(3 * face_source.size());
  for (std::size_t i = 0; i < result.of_corner.size(); ++i)
    result.of_corner[i] = metric.of_corner[3 * std::size_t{face_source[i / 3].index()} + i % 3];
  return result;
}

}  // namespace mesher::simplify
