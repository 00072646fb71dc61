#include "engine/simplify/attributes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/wedges.h"
#include "engine/simplify/attribute_metric.h"
#include "engine/simplify/prune.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kCarryGrain = std::size_t{1} << 10;
/// Times of simplifying, and of carrying attributes over.
constexpr double kModelWeights[] = {0.8, 0.2};
// A walk ends when so many faces in a row were not nearer.
constexpr int kPatience = 12;
// Squared ratio of distances within which faces are in the vicinity of a point.
constexpr double kVicinity2 = 4.0;
// Faces between the ends of two walks that lead to one place, at most.
constexpr std::size_t kMostBetween = 256;

/// Whether the values of a layer differ across an edge.
class SeamTest {
 public:
  SeamTest(const Mesh& mesh, const Attributes& attributes) : mesh_(mesh), attributes_(attributes) {}

  Wedge wedge(Halfedge h) const { return attributes_.wedge(mesh_.origins(), h); }

  /// Returns whether an edge separates wedges. A boundary does not.
  bool is_seam(Halfedge h) const {
    const Halfedge t = mesh_.twin(h);
    if (!t.is_valid() || !attributes_.has_seams()) return false;
    return wedge(h) != wedge(Mesh::next(t)) || wedge(Mesh::next(h)) != wedge(t);
  }
  /// Returns whether the values of one layer differ across an edge. Pre: it is not a boundary.
  bool is_seam(Halfedge h, const AttributeLayer& layer) const {
    const Halfedge t = mesh_.twin(h);
    return differ(layer, wedge(h), wedge(Mesh::next(t))) ||
           differ(layer, wedge(Mesh::next(h)), wedge(t));
  }

 private:
  static bool differ(const AttributeLayer& layer, Wedge a, Wedge b) {
    return a != b && std::memcmp(layer.value(a.index()).data(), layer.value(b.index()).data(),
                                 layer.type().value_bytes()) != 0;
  }

  const Mesh& mesh_;
  const Attributes& attributes_;
};

glm::dvec3 vector_of(const AttributeValue& value) {
  return {value[0], value[1], value[2]};
}

/// Returns the length-1 vector, or the vector itself if it has no direction.
glm::dvec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : v;
}

/// Returns the cosine between the normals on both sides of an edge, the smaller of its two ends.
double normal_cosine(const SeamTest& test, const AttributeLayer& normals, const Mesh& mesh,
                     Halfedge h) {
  const Halfedge t = mesh.twin(h);
  const auto normal = [&](Halfedge corner) {
    return unit(vector_of(load(normals, test.wedge(corner).index())));
  };
  return std::min(glm::dot(normal(h), normal(Mesh::next(t))),
                  glm::dot(normal(Mesh::next(h)), normal(t)));
}

/// Returns whether the faces of an edge differ in material, or belong to different primitives.
bool is_material_border(const Mesh& mesh, const Attributes& attributes, Halfedge h) {
  const Halfedge t = mesh.twin(h);
  if (attributes.group.empty() || !t.is_valid()) return false;
  const std::uint32_t a = attributes.group[Mesh::face(h).index()];
  const std::uint32_t b = attributes.group[Mesh::face(t).index()];
  if (a == b) return false;
  return attributes.groups[a].material != attributes.groups[b].material ||
         attributes.groups[a].primitive != attributes.groups[b].primitive;
}

/// Returns false if no edge can separate values or materials.
bool may_have_lines(const Attributes& attributes) {
  const auto is_like_first = [&](const FaceGroup& group) {
    return group.material == attributes.groups.front().material &&
           group.primitive == attributes.groups.front().primitive;
  };
  return attributes.has_seams() || !std::ranges::all_of(attributes.groups, is_like_first);
}

/// Morph targets that only shade.
bool is_shading_delta(const AttributeType& type) {
  return type.kind == AttributeKind::delta &&
         (type.name.ends_with("NORMAL") || type.name.ends_with("TANGENT"));
}

bool is_line(const SeamTest& test, const Mesh& mesh, const Attributes& attributes, Halfedge h) {
  if (is_material_border(mesh, attributes, h)) return true;
  if (!test.is_seam(h)) return false;
  for (const AttributeLayer& layer : attributes.layers) {
    // A tangent follows from the normal and the texture coordinates.
    if (layer.type().kind == AttributeKind::tangent || is_shading_delta(layer.type())) continue;
    if (!test.is_seam(h, layer)) continue;
    if (layer.type().kind != AttributeKind::normal) return true;
    if (normal_cosine(test, layer, mesh, h) < std::cos(kHardEdgeDegrees * std::numbers::pi / 180.0))
      return true;
  }
  return false;
}

/// A point of the input's surface.
struct SurfacePoint {
  Face face;
  glm::dvec3 weights{1.0, 0.0, 0.0};  ///< barycentric
  double distance2 = std::numeric_limits<double>::infinity();
};

/// Returns the weights of the nearest point of a segment.
glm::dvec2 nearest_on_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return {1.0 - t, t};
}

/// Returns the nearest point of a triangle. A corner has the weight 1 exactly.
SurfacePoint nearest_on_face(const Mesh& mesh, Face f, const glm::dvec3& p) {
  glm::dvec3 corner[3];
  for (std::uint32_t c = 0; c < 3; ++c)
    corner[c] = glm::dvec3(mesh.position(mesh.origin(Mesh::halfedge(f, c))));
  SurfacePoint nearest{.face = f};
  const auto offer = [&](const glm::dvec3& weights) {
    const glm::dvec3 q = weights.x * corner[0] + weights.y * corner[1] + weights.z * corner[2];
    const double distance2 = glm::dot(p - q, p - q);
    if (distance2 < nearest.distance2) nearest = {f, weights, distance2};
  };
  const glm::dvec3 ab = corner[1] - corner[0];
  const glm::dvec3 ac = corner[2] - corner[0];
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double area2 = glm::dot(normal, normal);
  if (area2 > 0.0) {
    const double y = glm::dot(glm::cross(p - corner[0], ac), normal) / area2;
    const double z = glm::dot(glm::cross(ab, p - corner[0]), normal) / area2;
    if (y >= 0.0 && z >= 0.0 && y + z <= 1.0) {
      offer({1.0 - y - z, y, z});
      return nearest;
    }
  }
  for (int c = 0; c < 3; ++c) {
    const int next = (c + 1) % 3;
    const glm::dvec2 share = nearest_on_segment(p, corner[c], corner[next]);
    glm::dvec3 weights(0.0);
    weights[c] = share.x;
    weights[next] = share.y;
    offer(weights);
  }
  return nearest;
}

/// Walks over the faces of the input without crossing a seam.
class SeamlessWalk {
 public:
  SeamlessWalk(const Mesh& mesh, const SeamTest& seams) : mesh_(mesh), seams_(seams) {}

  /// Returns the nearest point to `p` that a walk from `start` towards it finds. The nearest face
  /// is always expanded first. A walk does not leave the vicinity of `p`, or it could go around a
  /// seam to its other side.
  SurfacePoint nearest(Face start, const glm::dvec3& p) {
    begin();
    const auto is_further = [](const SurfacePoint& a, const SurfacePoint& b) {
      return a.distance2 > b.distance2;
    };
    const auto visit = [&](Face f) {
      visited_.push_back(f);
      front_.push_back(nearest_on_face(mesh_, f, p));
      std::push_heap(front_.begin(), front_.end(), is_further);
    };
    visit(start);
    SurfacePoint best;
    for (int worse = 0; !front_.empty() && worse < kPatience && best.distance2 > 0.0;) {
      std::pop_heap(front_.begin(), front_.end(), is_further);
      const SurfacePoint at = front_.back();
      front_.pop_back();
      if (at.distance2 > kVicinity2 * best.distance2) break;
      if (at.distance2 < best.distance2) {
        best = at;
        worse = 0;
      } else {
        ++worse;
      }
      for_each_neighbor(at.face, visit);
    }
    return best;
  }

  /// Returns whether a walk leads from one point near `p` to another without leaving its vicinity.
  bool are_connected(const SurfacePoint& a, const SurfacePoint& b, const glm::dvec3& p) {
    if (a.face == b.face) return true;
    const double reach2 = kVicinity2 * std::max(a.distance2, b.distance2);
    begin();
    visited_.push_back(a.face);
    bool is_found = false;
    for (std::size_t i = 0; i < visited_.size() && !is_found; ++i) {
      if (visited_.size() >= kMostBetween) break;
      for_each_neighbor(visited_[i], [&](Face f) {
        is_found |= f == b.face;
        if (nearest_on_face(mesh_, f, p).distance2 <= reach2) visited_.push_back(f);
      });
    }
    return is_found;
  }

 private:
  void begin() {
    visited_.clear();
    front_.clear();
  }
  /// Calls `visit` for the neighbors that were not visited.
  template <class Visit>
  void for_each_neighbor(Face f, Visit&& visit) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Halfedge h = Mesh::halfedge(f, c);
      const Halfedge t = mesh_.twin(h);
      if (!t.is_valid() || seams_.is_seam(h)) continue;
      const Face other = Mesh::face(t);
      if (std::find(visited_.rbegin(), visited_.rend(), other) == visited_.rend()) visit(other);
    }
  }

  const Mesh& mesh_;
  const SeamTest& seams_;
  std::vector<Face> visited_;  // short: walks are
  std::vector<SurfacePoint> front_;
};

/// Sets a value to that of a point of the input's surface.
class Blend {
 public:
  Blend(const SeamTest& seams, const AttributeLayer& from, AttributeLayer& to)
      : seams_(seams), from_(from), to_(to) {}

  void operator()(const SurfacePoint& point, std::size_t i) const {
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

/// Returns the groups of faces that were those of the input.
Attributes carried_groups(const Attributes& attributes, std::span<const Face> face_source) {
  Attributes carried;
  carried.groups = attributes.groups;
  if (attributes.group.empty()) return carried;
  carried.group.resize(face_source.size());
  for (std::size_t f = 0; f < face_source.size(); ++f)
    carried.group[f] = attributes.group[face_source[f].index()];
  return carried;
}

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
        progress_(progress) {}

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
    parallel_chunks(result_.vertex_count(), kCarryGrain, progress_,
                    [&](std::size_t, IndexRange range) {
                      SeamlessWalk walk(input_.mesh, seams_);
                      for (std::size_t v = range.begin; v < range.end; ++v)
                        find_points_at(Vertex(static_cast<std::uint32_t>(v)), walk);
                    });
  }

  void find_points_at(Vertex v, SeamlessWalk& walk) {
    const glm::dvec3 p(result_.position(v));
    const bool may_differ = input_.attributes.has_seams();
    std::vector<SurfacePoint> found;  // one per place
    for (const Halfedge h : halfedges_around(result_, v)) {
      if (!found.empty() && !may_differ) {
        point_[h.index()] = found.front();
        continue;
      }
      const SurfacePoint point = walk.nearest(face_source_[Mesh::face(h).index()], p);
      const auto same = std::find_if(found.begin(), found.end(), [&](const SurfacePoint& other) {
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
      if (from.type().kind == AttributeKind::normal && has_normal_per_face(from)) {
        set_face_normals(to);
        continue;
      }
      if (set_followed(i, from, to)) continue;
      const Blend blend(seams_, from, to);
      parallel_chunks(point_.size(), kCarryGrain, progress_, [&](std::size_t, IndexRange range) {
        for (std::size_t h = range.begin; h < range.end; ++h) {
          if (!keep(from, h, to)) blend(point_[h], h);
        }
      });
    }
    return stream;
  }

  /// Copies the value of a corner that kept its wedge. Returns false if it did not.
  bool keep(const AttributeLayer& from, std::size_t h, AttributeLayer& to) const {
    if (followed_ == nullptr || followed_->corners.source[h] == kNone) return false;
    std::ranges::copy(from.value(followed_->corners.source[h]), to.value(h).begin());
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
    const bool has_unit_length = from.type().kind == AttributeKind::normal;
    parallel_for(to.count(), kCarryGrain, [&](IndexRange range) {
      for (std::size_t h = range.begin; h < range.end; ++h) {
        if (keep(from, h, to)) continue;
        AttributeValue value{};
        for (std::size_t k = 0; k < from.type().components; ++k)
          value[k] = double{followed_->corners.values[size * h + first + k]} / factor;
        if (has_unit_length) {
          const glm::dvec3 n = unit(vector_of(value));
          value = {n.x, n.y, n.z, value[3]};
        }
        store(to, h, value);
      }
    });
  }

  bool has_normal_per_face(const AttributeLayer& normals) const {
    const Mesh& mesh = input_.mesh;
    std::size_t seams = 0;
    std::size_t others = 0;
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      if (mesh.is_boundary(Halfedge(h))) continue;
      ++(seams_.is_seam(Halfedge(h)) && seams_.is_seam(Halfedge(h), normals) ? seams : others);
    }
    return seams > others;
  }

  void set_face_normals(AttributeLayer& layer) const {
    parallel_for_each(result_.face_count(), kCarryGrain, [&](std::uint32_t f) {
      const auto p = [&](std::uint32_t c) {
        return glm::dvec3(result_.position(result_.origin(Mesh::halfedge(Face(f), c))));
      };
      const glm::dvec3 n = unit(glm::cross(p(1) - p(0), p(2) - p(0)));
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
  Array<SurfacePoint> point_;  ///< per corner of the result
};

}  // namespace

void mark_seams(Mesh& mesh, const Attributes& attributes) {
  if (!may_have_lines(attributes)) return;
  const SeamTest test(mesh, attributes);
  const MeshArrays::InPlace arrays = MeshArrays::open(mesh);
  parallel_for_each(mesh.halfedge_count(), kCarryGrain, [&](std::uint32_t h) {
    if (!(arrays.sharpness[h] > 0.0F) && is_line(test, mesh, attributes, Halfedge(h)))
      arrays.sharpness[h] = kSeamSharpness;
  });
}

void unmark_seams(Mesh& mesh) {
  const MeshArrays::InPlace arrays = MeshArrays::open(mesh);
  for (float& sharpness : arrays.sharpness) {
    if (sharpness == kSeamSharpness) sharpness = 0.0F;
  }
}

SimplifiedModel simplify_model(Mesh&& mesh, const Attributes& attributes,
                               const SimplifyOptions& options, bool prunes) {
  const auto run = [&](Mesh&& input, const AttributeMetric* metric) {
    SimplifyOptions run_options = options;
    run_options.metric = metric != nullptr && metric->size > 0 ? metric : nullptr;
    return prunes ? simplify_pruned(std::move(input), run_options)
                  : simplify(std::move(input), run_options);
  };
  SimplifiedModel result;
  const bool has_lines = may_have_lines(attributes);
  if (attributes.layers.empty() && !has_lines) {
    result.simplified = run(std::move(mesh), nullptr);
    result.attributes = carried_groups(attributes, result.simplified.face_source);
    return result;
  }
  Stages stages(options.progress, kModelWeights);
  stages.next();
  Mesh marked(mesh);
  mark_seams(marked, attributes);
  const AttributeMetric metric = attribute_metric(mesh, attributes, options.weights());
  result.simplified = run(std::move(marked), &metric);
  const bool is_stuck = result.simplified.report.reason == StopReason::no_legal_collapse &&
                        result.simplified.report.faces_reached > options.target_faces;
  if (has_lines && options.target_faces > 0 && is_stuck) {
    Simplified across = run(Mesh(mesh), nullptr);
    result.crosses_seams = across.report.faces_reached < result.simplified.report.faces_reached;
    if (result.crosses_seams) result.simplified = std::move(across);
  }
  unmark_seams(result.simplified.mesh);
  stages.next();
  result.attributes =
      carry_attributes({mesh, attributes}, result.simplified, metric, options.progress);
  return result;
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
