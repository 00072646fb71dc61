#include "engine/simplify/carry_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/analysis/surface_point.h"
#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/joints.h"
#include "engine/mesh/wedges.h"
#include "engine/simplify/attribute_metric.h"
#include "engine/simplify/carry_tangents.h"
#include "engine/simplify/seams.h"
#include "engine/simplify/surface_walk.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kCarryGrain = std::size_t{1} << 10;

glm::dvec3 vector_of(const AttributeValue& value) {
  return {value[0], value[1], value[2]};
}

/// Returns the length-1 vector, or the vector itself if it has no direction.
glm::dvec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : v;
}

/// Sets a value to that of a point of the input's surface.
class Blend {
 public:
  Blend(const SeamTest& seams, const AttributeLayer& from, AttributeLayer& to)
      : seams_(seams), from_(from), to_(to) {}

  void operator()(const NearPoint& point, std::size_t i) const {
    std::uint32_t nearest = 0;
    std::size_t wedges[3];
    for (std::uint32_t c = 0; c < 3; ++c) {
      wedges[c] = seams_.wedge(Mesh::halfedge(point.face, c)).index();
      if (point.weights[static_cast<int>(c)] > point.weights[static_cast<int>(nearest)])
        nearest = c;
    }
    const bool has_all =
        std::none_of(wedges, wedges + 3, [&](std::size_t w) { return is_absent(from_, w); });
    if (point.weights[static_cast<int>(nearest)] == 1.0 || !has_all || !can_blend(from_.type())) {
      std::ranges::copy(from_.value(wedges[nearest]), to_.value(i).begin());
      return;
    }
    AttributeValue sum{};
    for (int c = 0; c < 3; ++c) {
      const AttributeValue value = load(from_, wedges[c]);
      for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] += point.weights[c] * value[k];
    }
    normalize(sum, load(from_, wedges[nearest]));
    store(to_, i, sum);
  }

 private:
  void normalize(AttributeValue& value, const AttributeValue& nearest) const {
    const AttributeKind kind = from_.type().kind;
    if (kind != AttributeKind::normal && kind != AttributeKind::tangent) return;
    glm::dvec3 v = vector_of(value);
    v = glm::length(v) > 0.0 ? unit(v) : vector_of(nearest);
    for (int k = 0; k < 3; ++k)
      value[static_cast<std::size_t>(k)] = v[k];
    value[3] = nearest[3];
  }

  const SeamTest& seams_;
  const AttributeLayer& from_;
  AttributeLayer& to_;
};

/// Sets the joints of corners to those of points of the input's surface.
class JointBlend {
 public:
  JointBlend(const SeamTest& seams, std::span<const AttributeLayer> from,
             std::span<const JointSet> sets, std::span<AttributeLayer> to)
      : seams_(seams), from_(from), sets_(sets), to_(to) {}

  void operator()(const NearPoint& point, std::size_t i) {
    sum_.clear();
    for (std::uint32_t c = 0; c < 3; ++c) {
      const double share = point.weights[static_cast<int>(c)];
      const std::size_t wedge = seams_.wedge(Mesh::halfedge(point.face, c)).index();
      if (share == 1.0) return copy(wedge, i);
      if (share > 0.0) sum_.add(from_, sets_, wedge, share);
    }
    if (!sum_.store(to_, sets_, i)) copy(seams_.wedge(Mesh::halfedge(point.face, 0)).index(), i);
  }
  void copy(std::size_t wedge, std::size_t i) const {
    for (const JointSet& set : sets_) {
      for (const std::size_t layer : {set.joints, set.weights})
        std::ranges::copy(from_[layer].value(wedge), to_[layer].value(i).begin());
    }
  }

 private:
  const SeamTest& seams_;
  std::span<const AttributeLayer> from_;
  std::span<const JointSet> sets_;
  std::span<AttributeLayer> to_;
  JointSum sum_;
};

/// The attributes that a simplification followed.
struct Followed {
  const AttributeMetric& metric;
  const CornerVectors& corners;
};

class Carrier {
 public:
  Carrier(const Attributed& input, const Mesh& result, std::span<const Face> face_source,
          const Followed* followed, Progress* progress)
      : input_(input),
        seams_(input.mesh, input.attributes),
        result_(result),
        face_source_(face_source),
        followed_(followed),
        progress_(progress),
        joints_(joint_sets(input.attributes.layers)) {}

  Attributes run() {
    Stages stages(progress_, {0.7, 0.3});
    stages.next();
    const std::size_t known = followed_ != nullptr ? followed_->metric.layers.size() : 0;
    if (known < input_.attributes.layers.size()) find_points();
    stages.next();
    Attributes carried = make_wedges(result_, {streams()}, progress_);
    Attributes groups = carried_groups(input_.attributes, face_source_);
    carried.group = std::move(groups.group);
    carried.groups = std::move(groups.groups);
    return carried;
  }

 private:
  /// Finds a point of the input for each run of corners around a vertex that lead to one place.
  void find_points() {
    point_.resize(result_.halfedge_count());
    const Lines lines(input_.mesh, input_.attributes);
    const WalkRescue rescue(input_.mesh, lines);
    parallel_chunks(result_.vertex_count(), kCarryGrain, progress_,
                    [&](std::size_t, IndexRange range) {
                      SurfaceWalk walk(input_.mesh, lines);
                      for (std::size_t v = range.begin; v < range.end; ++v)
                        find_points_at(Vertex(static_cast<std::uint32_t>(v)), walk, rescue);
                    });
  }

  void find_points_at(Vertex v, SurfaceWalk& walk, const WalkRescue& rescue) {
    const glm::dvec3 p(result_.position(v));
    const bool may_differ = input_.attributes.has_seams();
    std::vector<NearPoint> found;  // one per place
    for (const Halfedge h : halfedges_around(result_, v)) {
      if (!found.empty() && !may_differ) {
        point_[h.index()] = found.front();
        continue;
      }
      NearPoint point = walk.nearest(face_source_[Mesh::face(h).index()], p);
      if (const std::optional<Face> nearer = rescue.nearer(point, p))
        point = walk.nearest(*nearer, p);
      const auto same = std::find_if(found.begin(), found.end(), [&](const NearPoint& other) {
        return walk.are_connected(other, point, p);
      });
      if (same != found.end()) {
        point_[h.index()] = *same;
        continue;
      }
      found.push_back(point);
      point_[h.index()] = point;
    }
  }

  AttributeStream streams() {
    AttributeStream stream;
    stream.index.resize(result_.halfedge_count());
    std::iota(stream.index.begin(), stream.index.end(), 0U);
    for (std::size_t i = 0; i < input_.attributes.layers.size(); ++i) {
      const AttributeLayer& from = input_.attributes.layers[i];
      AttributeLayer& to = stream.layers.emplace_back(from.type(), result_.halfedge_count());
      if (from.type().kind == AttributeKind::normal && seams_.has_value_per_face(from)) {
        set_face_normals(to);
        continue;
      }
      if (set_followed(i, from, to) || is_joint_layer(i)) continue;
      const Blend blend(seams_, from, to);
      parallel_chunks(point_.size(), kCarryGrain, progress_, [&](std::size_t, IndexRange range) {
        for (std::size_t h = range.begin; h < range.end; ++h) {
          if (!keep(from, h, to)) blend(point_[h], h);
        }
      });
    }
    if (!joints_.empty()) set_joints(stream.layers);
    if (result_.face_count() < input_.mesh.face_count()) rebuild_tangents(input_, result_, stream);
    return stream;
  }

  bool is_joint_layer(std::size_t index) const {
    return std::ranges::any_of(
        joints_, [&](const JointSet& set) { return set.joints == index || set.weights == index; });
  }

  void set_joints(std::span<AttributeLayer> to) const {
    parallel_chunks(point_.size(), kCarryGrain, progress_, [&](std::size_t, IndexRange range) {
      JointBlend blend(seams_, input_.attributes.layers, joints_, to);
      for (std::size_t h = range.begin; h < range.end; ++h) {
        const std::uint32_t kept = kept_wedge(h);
        kept == kNone ? blend(point_[h], h) : blend.copy(kept, h);
      }
    });
  }

  /// Returns the wedge of the input that a corner kept; kNone if it did not.
  std::uint32_t kept_wedge(std::size_t h) const {
    return followed_ == nullptr ? kNone : followed_->corners.source[h];
  }
  /// Copies the value of a corner that kept its wedge. Returns false if it did not.
  bool keep(const AttributeLayer& from, std::size_t h, AttributeLayer& to) const {
    const std::uint32_t kept = kept_wedge(h);
    if (kept == kNone) return false;
    std::ranges::copy(from.value(kept), to.value(h).begin());
    return true;
  }

  /// Sets the values of a layer of the metric. Returns false if it is none.
  bool set_followed(std::size_t index, const AttributeLayer& from, AttributeLayer& to) const {
    if (followed_ == nullptr) return false;
    for (const AttributeMetric::Layer& layer : followed_->metric.layers) {
      if (layer.index != index) continue;
      set_values(layer.first, layer.factor, from, to);
      return true;
    }
    return false;
  }

  void set_values(std::size_t first, double factor, const AttributeLayer& from,
                  AttributeLayer& to) const {
    const std::size_t size = followed_->metric.size;
    const AttributeKind kind = from.type().kind;
    parallel_for(to.count(), kCarryGrain, [&](IndexRange range) {
      for (std::size_t h = range.begin; h < range.end; ++h) {
        if (keep(from, h, to)) continue;
        AttributeValue value{};
        for (std::size_t k = 0; k < from.type().components; ++k)
          value[k] = double{followed_->corners.values[size * h + first + k]} / factor;
        if (kind == AttributeKind::normal) {
          const glm::dvec3 n =
              normal_of(value, Mesh::face(Halfedge(static_cast<std::uint32_t>(h))));
          value = {n.x, n.y, n.z, value[3]};
        } else if (kind == AttributeKind::color) {
          // A mean of extrapolated values may lie beyond all of them.
          for (double& x : value)
            x = std::clamp(x, 0.0, 1.0);
        }
        store(to, h, value);
      }
    });
  }

  glm::dvec3 face_normal(Face f) const {
    const std::array<glm::dvec3, 3> p = analysis::corners_of(result_, f);
    return unit(glm::cross(p[1] - p[0], p[2] - p[0]));
  }
  /// Returns the direction of a value; that of the face if it has none.
  glm::dvec3 normal_of(const AttributeValue& value, Face f) const {
    const glm::dvec3 n = vector_of(value);
    return glm::dot(n, n) > 0.0 ? unit(n) : face_normal(f);
  }

  void set_face_normals(AttributeLayer& layer) const {
    parallel_for_each(result_.face_count(), kCarryGrain, [&](std::uint32_t f) {
      const glm::dvec3 n = face_normal(Face(f));
      for (std::uint32_t c = 0; c < 3; ++c)
        store(layer, 3 * std::size_t{f} + c, {n.x, n.y, n.z, 0.0});
    });
  }

  const Attributed& input_;
  SeamTest seams_;
  const Mesh& result_;
  std::span<const Face> face_source_;
  const Followed* followed_;
  Progress* progress_;
  std::vector<JointSet> joints_;
  Array<NearPoint> point_;  ///< per corner of the result
};

}  // namespace

Attributes carried_groups(const Attributes& attributes, std::span<const Face> face_source) {
  Attributes carried;
  carried.groups = attributes.groups;
  if (attributes.group.empty()) return carried;
  carried.group.resize(face_source.size());
  for (std::size_t f = 0; f < face_source.size(); ++f)
    carried.group[f] = attributes.group[face_source[f].index()];
  return carried;
}

Attributes carry_attributes(const Attributed& input, const Simplified& result,
                            const AttributeMetric& metric, Progress* progress) {
  if (input.attributes.layers.empty() || result.mesh.face_count() == 0 ||
      result.corners.is_empty()) {
    return carry_attributes(input, result.mesh, result.face_source, progress);
  }
  const Followed followed{metric, result.corners};
  return Carrier(input, result.mesh, result.face_source, &followed, progress).run();
}

Attributes carry_attributes(const Attributed& input, const Mesh& result,
                            std::span<const Face> face_source, Progress* progress) {
  if (input.attributes.is_empty()) return {};
  if (input.attributes.layers.empty() || result.face_count() == 0) {
    return carried_groups(input.attributes, face_source);
  }
  return Carrier(input, result, face_source, nullptr, progress).run();
}

}  // namespace mesher::simplify
