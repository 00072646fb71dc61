#include "engine/subdivide/attributes.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mesh/joints.h"
#include "engine/mesh/normals.h"
#include "engine/mesh/wedges.h"
#include "engine/subdivide/charts.h"

namespace mesher::subdivide {
namespace {

constexpr std::size_t kAttributeGrain = 4096;

/// Calls `split(from, to)` per corner of the four children of each face, in the order of `refine`:
/// `from` are two corners of the coarse face, equal at its own corners, whose middle is at `to`.
template <class Split>
void for_each_child_corner(std::size_t coarse_corners, Progress* progress, const Split& split) {
  constexpr std::size_t kEnds[12][2] = {{0, 0}, {0, 1}, {2, 0}, {0, 1}, {1, 1}, {1, 2},
                                        {2, 0}, {1, 2}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  parallel_chunks(coarse_corners / 3, kAttributeGrain, progress,
                  [&](std::size_t, IndexRange faces) {
                    for (std::size_t f = faces.begin; f < faces.end; ++f) {
                      for (std::size_t c = 0; c < 12; ++c)
                        split(3 * f + kEnds[c][0], 3 * f + kEnds[c][1], 12 * f + c);
                    }
                  });
}

AttributeLayer split_layer(const AttributeLayer& corner, Progress* progress) {
  AttributeLayer child(corner.type(), 4 * corner.count());
  const std::size_t components = corner.type().components;
  if (corner.type().component == ComponentType::f32) {
    const auto* from = reinterpret_cast<const float*>(corner.bytes().data());
    auto* to = reinterpret_cast<float*>(child.bytes().data());
    for_each_child_corner(
        corner.count(), progress, [&](std::size_t a, std::size_t b, std::size_t c) {
          for (std::size_t k = 0; k < components; ++k)
            to[c * components + k] =
                a == b ? from[a * components + k]
                       : 0.5F * (from[a * components + k] + from[b * components + k]);
        });
    return child;
  }
  for_each_child_corner(corner.count(), progress, [&](std::size_t a, std::size_t b, std::size_t c) {
    store_mean(child, c, corner, a, b);
  });
  return child;
}

/// Splits the layers of joints. The joints of a middle are those of both ends, with half of their
/// weights.
std::vector<AttributeLayer> split_joints(const std::vector<AttributeLayer>& corner,
                                         Progress* progress) {
  if (corner.empty()) return {};
  std::vector<AttributeLayer> child;
  child.reserve(corner.size());
  for (const AttributeLayer& layer : corner)
    child.emplace_back(layer.type(), 4 * layer.count());
  const std::vector<JointSet> sets = joint_sets(corner);
  for_each_child_corner(corner.front().count(), progress,
                        [&](std::size_t a, std::size_t b, std::size_t c) {
                          thread_local JointSum sum;
                          sum.clear();
                          if (a != b) {
                            sum.add(corner, sets, a, 0.5);
                            sum.add(corner, sets, b, 0.5);
                          }
                          if (a != b && sum.store(child, sets, c)) return;
                          for (std::size_t i = 0; i < corner.size(); ++i)
                            std::ranges::copy(corner[i].value(a), child[i].value(c).begin());
                        });
  return child;
}

template <class T, class Middle>
Array<T> split_ids(const Array<T>& corner, Progress* progress, const Middle& middle) {
  Array<T> child(4 * corner.size());
  for_each_child_corner(corner.size(), progress, [&](std::size_t a, std::size_t b, std::size_t c) {
    child[c] = middle(corner[a], corner[b]);
  });
  return child;
}

Array<std::uint32_t> split_groups(const Array<std::uint32_t>& group, Progress* progress) {
  Array<std::uint32_t> child(4 * group.size());
  parallel_chunks(child.size(), kAttributeGrain, progress, [&](std::size_t, IndexRange faces) {
    for (std::size_t f = faces.begin; f < faces.end; ++f)
      child[f] = group[f / 4];
  });
  return child;
}

bool is_dropped(const AttributeLayer& layer) {
  return layer.type().kind == AttributeKind::tangent;
}

/// Returns whether a layer is subdivided by the scheme. Midpoint is linear anyway.
bool is_smooth(const AttributeLayer& layer, const SubdivideOptions& options) {
  constexpr std::size_t kMostComponents = 3;  // those of a position
  const AttributeType& type = layer.type();
  return options.uv == UvInterpolation::smooth && options.scheme != Scheme::midpoint &&
         type.kind == AttributeKind::texcoord && type.components <= kMostComponents &&
         can_blend(type);
}

/// Sets interpolated normals, one per corner, to those of the surface. They are split where the
/// interpolated ones are, and at creases. Corners without a normal stay so.
void compute_normals(const Mesh& mesh, AttributeLayer& layer) {
  const auto differ = [&](Halfedge a, Halfedge b) {
    return !std::ranges::equal(layer.value(a.index()), layer.value(b.index()));
  };
  Array<std::uint8_t> splits(mesh.halfedge_count());
  parallel_for_each(mesh.halfedge_count(), kAttributeGrain, [&](std::uint32_t i) {
    const Halfedge h(i);
    const Halfedge t = mesh.twin(h);
    const bool is_split = t.is_valid() && (differ(h, Mesh::next(t)) || differ(Mesh::next(h), t));
    splits[i] = is_split ? 1 : 0;
  });
  const Array<glm::vec3> normals = corner_normals(mesh, {.splits = splits});
  parallel_for_each(mesh.halfedge_count(), kAttributeGrain, [&](std::uint32_t h) {
    const glm::dvec3 normal(normals[h]);
    if (!is_absent(layer, h) && normal != glm::dvec3(0.0))
      store(layer, h, {normal.x, normal.y, normal.z, 0.0});
  });
}

/// Attributes of one level with values per corner.
struct CornerLevel {
  std::vector<AttributeLayer> blended;  ///< smooth layers are empty: they need no level
  std::vector<AttributeLayer> joints;   ///< those of joint_sets
  Array<std::uint32_t> source;  ///< wedge that the other layers are copied from; may be empty
  Array<std::uint32_t> group;
};

/// Returns which layers are those of joint_sets.
std::vector<bool> joint_layers(const Attributes& attributes) {
  std::vector<bool> are(attributes.layers.size(), false);
  for (const JointSet& set : joint_sets(attributes.layers))
    are[set.joints] = are[set.weights] = true;
  return are;
}

CornerLevel corner_level(const Mesh& mesh, const Attributes& attributes,
                         const SubdivideOptions& options) {
  CornerLevel level;
  const std::size_t corners = mesh.halfedge_count();
  const auto spread = [&](const AttributeLayer& layer) {
    AttributeLayer by_corner(layer.type(), corners);
    parallel_for_each(corners, kAttributeGrain, [&](std::uint32_t h) {
      const Wedge w = attributes.wedge(mesh.origins(), Halfedge(h));
      std::ranges::copy(layer.value(w.index()), by_corner.value(h).begin());
    });
    return by_corner;
  };
  const std::vector<bool> is_joint = joint_layers(attributes);
  bool has_copied = false;
  for (std::size_t i = 0; i < attributes.layers.size(); ++i) {
    const AttributeLayer& layer = attributes.layers[i];
    if (is_dropped(layer)) continue;
    if (is_joint[i]) {
      level.joints.push_back(spread(layer));
    } else if (!can_blend(layer.type())) {
      has_copied = true;
    } else if (is_smooth(layer, options)) {
      level.blended.emplace_back(layer.type(), 0);
    } else {
      level.blended.push_back(spread(layer));
    }
  }
  if (has_copied) {
    level.source.resize(corners);
    for (std::uint32_t h = 0; h < corners; ++h)
      level.source[h] = attributes.wedge(mesh.origins(), Halfedge(h)).index();
  }
  level.group = attributes.group;
  return level;
}

CornerLevel refined(const CornerLevel& coarse, Progress* progress) {
  CornerLevel fine;
  Stages stages(progress, {1.0, 0.3, 0.1});
  stages.next();
  {
    Stages layers(progress,
                  std::vector<double>(std::max<std::size_t>(1, coarse.blended.size()), 1.0));
    for (const AttributeLayer& layer : coarse.blended) {
      layers.next();
      fine.blended.push_back(split_layer(layer, progress));
    }
  }
  fine.joints = split_joints(coarse.joints, progress);
  stages.next();
  fine.source = split_ids(coarse.source, progress,
                          [](std::uint32_t a, std::uint32_t b) { return std::min(a, b); });
  stages.next();
  fine.group = split_groups(coarse.group, progress);
  return fine;
}

std::vector<AttributeStream> to_streams(const Attributes& attributes, CornerLevel&& level,
                                        std::size_t corners) {
  std::vector<AttributeStream> streams(2);
  streams[0].layers = std::move(level.blended);
  std::ranges::move(level.joints, std::back_inserter(streams[0].layers));
  streams[0].index.resize(corners);
  parallel_for_each(corners, kAttributeGrain, [&](std::uint32_t h) { streams[0].index[h] = h; });
  if (level.source.empty()) return streams;
  streams[1].index = std::move(level.source);
  const std::vector<bool> is_joint = joint_layers(attributes);
  for (std::size_t i = 0; i < attributes.layers.size(); ++i) {
    const AttributeLayer& layer = attributes.layers[i];
    if (!is_dropped(layer) && !is_joint[i] && !can_blend(layer.type()))
      streams[1].layers.push_back(layer);
  }
  return streams;
}

/// Sets the layers that the levels left empty.
void fill_smooth_layers(const Mesh& coarse, const Attributes& attributes,
                        const SubdivideOptions& options, CornerLevel& level) {
  std::vector<double> weights(std::max<std::size_t>(1, level.blended.size()), 1.0);
  Stages stages(options.progress, weights);
  for (AttributeLayer& layer : level.blended) {
    stages.next();
    const AttributeLayer& source = *attributes.find(layer.type().name);
    if (is_smooth(source, options)) layer = subdivide_charts(coarse, attributes, source, options);
  }
}

/// The times of the levels, of smooth layers, and of making the wedges.
std::vector<double> stage_weights(std::uint32_t levels) {
  std::vector<double> weights{1.0};
  while (weights.size() < levels)
    weights.push_back(4.0 * weights.back());
  const double last = weights.back();
  weights.insert(weights.end(), {2.0 * last, 2.0 * last});
  return weights;
}

}  // namespace

Attributes subdivide_attributes(const Mesh& coarse, const Attributes& attributes, const Mesh& fine,
                                const SubdivideOptions& options) {
  if (options.levels == 0) return attributes;
  Progress* const progress = options.progress;
  Stages stages(progress, stage_weights(options.levels));
  CornerLevel level = corner_level(coarse, attributes, options);
  for (std::uint32_t i = 0; i < options.levels; ++i) {
    stages.next();
    level = refined(level, progress);
  }
  stages.next();
  for (AttributeLayer& layer : level.blended) {
    if (layer.type().kind == AttributeKind::normal) compute_normals(fine, layer);
  }
  fill_smooth_layers(coarse, attributes, options, level);
  stages.next();
  Array<std::uint32_t> group = std::move(level.group);
  Attributes result =
      make_wedges(fine, to_streams(attributes, std::move(level), fine.halfedge_count()), progress);
  result.group = std::move(group);
  result.groups = attributes.groups;
  return result;
}

std::size_t subdivided_attribute_bytes(const Mesh& coarse, const Attributes& attributes,
                                       const SubdivideOptions& options) {
  if (options.levels == 0 || attributes.is_empty()) return 0;
  std::size_t per_corner = sizeof(std::uint32_t);
  std::size_t charts = 0;
  for (const AttributeLayer& layer : attributes.layers) {
    per_corner += layer.type().value_bytes();
    if (is_smooth(layer, options)) charts = chart_bytes(coarse, options.levels);
  }
  const std::size_t bytes =
      coarse.halfedge_count() * per_corner + attributes.group.size() * sizeof(std::uint32_t);
  const std::size_t last = bytes << (2 * options.levels);
  return last + last / 4 + charts;
}

}  // namespace mesher::subdivide
