#include "engine/simplify/attribute_policy.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "engine/core/array.h"
#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher::simplify {
namespace {

/// Base of the policies that place the vertex like the default policy.
class PlacedPolicy : public CollapsePolicy {
 public:
  explicit PlacedPolicy(Placement placement) : placement_(placement) {}

 protected:
  /// Returns the candidate with a cost of 0.
  Candidate placed(const Surface& surface, Halfedge h, AllowedPlacement allowed) const {
    const EdgeQuadric<float> edge = surface.edge_quadric(h);
    const Placed at = place(surface, h, edge, placement_, allowed);
    return {0.0F, std::max(edge.cost(at.offset), 0.0F), at.position};
  }

 private:
  Placement placement_;
};

float squared_length(const Surface& surface, Halfedge h) {
  const Mesh& mesh = surface.mesh();
  const glm::vec3 edge = mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h));
  return glm::dot(edge, edge);
}

/// Cost: the squared length of the edge.
class LengthPolicy : public PlacedPolicy {
 public:
  using PlacedPolicy::PlacedPolicy;
  Candidate evaluate(const Surface& surface, Halfedge h, AllowedPlacement allowed) const override {
    Candidate candidate = placed(surface, h, allowed);
    candidate.cost = squared_length(surface, h);
    return candidate;
  }
};

/// Cost: a pseudorandom number in [0, 1) from the seed and both ends. All orders are equally
/// likely.
class RandomPolicy : public PlacedPolicy {
 public:
  RandomPolicy(Placement placement, std::uint64_t seed) : PlacedPolicy(placement), seed_(seed) {}

  Candidate evaluate(const Surface& surface, Halfedge h, AllowedPlacement allowed) const override {
    const Mesh& mesh = surface.mesh();
    const std::uint64_t low = std::min(mesh.origin(h), mesh.target(h)).index();
    const std::uint64_t high = std::max(mesh.origin(h), mesh.target(h)).index();
    Candidate candidate = placed(surface, h, allowed);
    candidate.cost = static_cast<float>(mixed(mixed(low << 32U | high) ^ seed_) >> 40U) * 0x1p-24F;
    return candidate;
  }

 private:
  /// The finalizer of splitmix64 (S. Vigna, 2015).
  static std::uint64_t mixed(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15U;
    x = (x ^ x >> 30U) * 0xBF58476D1CE4E5B9U;
    x = (x ^ x >> 27U) * 0x94D049BB133111EBU;
    return x ^ x >> 31U;
  }

  std::uint64_t seed_;
};

/// Cost: deviation of the new faces from equilateral. Each face contributes the sum of its squared
/// sides minus 4 sqrt(3) times its area, which is zero for an equilateral triangle (I.
/// Weitzenboeck, 1919). The squared length of the edge is added, so that among equal shapes the
/// smallest goes first.
class ShapePolicy : public PlacedPolicy {
 public:
  using PlacedPolicy::PlacedPolicy;

  Candidate evaluate(const Surface& surface, Halfedge h, AllowedPlacement allowed) const override {
    Candidate candidate = placed(surface, h, allowed);
    // One per thread, to avoid locks and allocations.
    thread_local Fan fan;
    if (!fan.gather(surface, h, kFewFaces)) {
      candidate.cost = std::numeric_limits<float>::max();
      return candidate;
    }
    const Mesh& mesh = surface.mesh();
    float cost = squared_length(surface, h);
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const glm::vec3 a = mesh.position(fan.ring()[i]) - candidate.position;
      const glm::vec3 b = mesh.position(fan.ring()[i + 1]) - candidate.position;
      const float sides = glm::dot(a, a) + glm::dot(b, b) + glm::dot(b - a, b - a);
      cost += std::max(sides - kTwoRootThree * glm::length(glm::cross(a, b)), 0.0F);
    }
    candidate.cost = cost;
    return candidate;
  }

 private:
  static constexpr std::size_t kFewFaces = 64;
  static constexpr float kTwoRootThree = 3.4641016F;  // for twice the area
};

/// x^T a x + 2 b.x + c, relative to a fixed origin.
struct FullQuadric {
  glm::dmat3 a{0.0};
  glm::dvec3 b{0.0};
  double c = 0.0;

  void add_plane(const glm::dvec3& normal, const glm::dvec3& point, double weight) {
    const double d = -glm::dot(normal, point);
    a += weight * glm::outerProduct(normal, normal);
    b += weight * d * normal;
    c += weight * d * d;
  }
  FullQuadric& operator+=(const FullQuadric& o) {
    a += o.a;
    b += o.b;
    c += o.c;
    return *this;
  }
  double cost(const glm::dvec3& x) const {
    return std::max(glm::dot(x, a * x) + 2.0 * glm::dot(b, x) + c, 0.0);
  }
};

/// Quadrics of the input's planes, weighted by area and summed along all collapses (M. Garland, P.
/// Heckbert, "Surface simplification using quadric error metrics", 1997). In double precision,
/// relative to the first vertex. 104 bytes per vertex.
class AccumulatedPolicy : public CollapsePolicy {
 public:
  AccumulatedPolicy(Placement placement, const Surface& surface)
      : placement_(placement), quadrics_(surface.mesh().vertex_count()) {
    const Mesh& mesh = surface.mesh();
    if (mesh.vertex_count() > 0) origin_ = mesh.position(Vertex(0));
    parallel_for(mesh.vertex_count(), kGrain, [&](IndexRange range) {
      for (std::size_t v = range.begin; v < range.end; ++v)
        quadrics_[v] = of_faces(surface, Vertex(static_cast<std::uint32_t>(v)));
    });
  }

  bool costs_are_errors() const override { return true; }
  bool has_history() const override { return true; }

  Candidate evaluate(const Surface& surface, Halfedge h, AllowedPlacement allowed) const override {
    const Mesh& mesh = surface.mesh();
    const glm::dvec3 from = glm::dvec3(mesh.position(mesh.origin(h))) - origin_;
    const glm::dvec3 to = glm::dvec3(mesh.position(mesh.target(h))) - origin_;
    FullQuadric q = quadrics_[mesh.origin(h).index()];
    q += quadrics_[mesh.target(h).index()];
    const auto [x, position] = place_by(q, surface, h, from, to, allowed);
    const auto error = static_cast<float>(q.cost(x));
    const auto length = static_cast<float>(glm::dot(to - from, to - from));
    const auto area = static_cast<float>(q.a[0][0] + q.a[1][1] + q.a[2][2]);
    return {error + kTieBreak * area * length, error, position};
  }

  void collapsing(const Surface& surface, Halfedge h, const Fan&, const glm::vec3&) override {
    const Mesh& mesh = surface.mesh();
    quadrics_[mesh.target(h).index()] += quadrics_[mesh.origin(h).index()];
  }

 private:
  static constexpr std::size_t kGrain = 1U << 12;

  FullQuadric of_faces(const Surface& surface, Vertex v) const {
    const Mesh& mesh = surface.mesh();
    FullQuadric q;
    if (mesh.is_isolated(v)) return q;
    const glm::dvec3 p = glm::dvec3(mesh.position(v)) - origin_;
    for (const Halfedge h : halfedges_around(mesh, v)) {
      const FaceShape& shape = surface.shape(Mesh::face(h));
      q.add_plane(shape.normal, p, shape.area);
      for (const Halfedge side : {h, Mesh::prev(h)}) {
        if (!surface.is_feature(side)) continue;
        const glm::vec3 edge = mesh.position(mesh.target(side)) - mesh.position(mesh.origin(side));
        q.add_plane(glm::cross(edge, shape.normal), p, 1.0);
      }
    }
    return q;
  }

  struct At {
    glm::dvec3 x;  ///< relative to the origin of the quadrics
    glm::vec3 position;
  };

  At place_by(const FullQuadric& q, const Surface& surface, Halfedge h, const glm::dvec3& from,
              const glm::dvec3& to, AllowedPlacement allowed) const {
    const Mesh& mesh = surface.mesh();
    if (allowed == AllowedPlacement::anywhere && placement_ == Placement::endpoint) {
      allowed =
          q.cost(from) < q.cost(to) ? AllowedPlacement::at_origin : AllowedPlacement::at_target;
    }
    if (allowed == AllowedPlacement::at_origin) return {from, mesh.position(mesh.origin(h))};
    if (allowed == AllowedPlacement::at_target) return {to, mesh.position(mesh.target(h))};
    const glm::dvec3 middle = 0.5 * (from + to);
    const glm::dvec3 x =
        placement_ == Placement::midpoint ? middle : middle + best_of(q, middle, to - from);
    return {x, glm::vec3(x + origin_)};
  }

  /// Same as best_offset: damped toward the midpoint, and within the ball around the edge.
  static glm::dvec3 best_of(const FullQuadric& q, const glm::dvec3& middle,
                            const glm::dvec3& edge) {
    const double damping = kPlacementDamping * (q.a[0][0] + q.a[1][1] + q.a[2][2]);
    if (!(damping > 0.0)) return glm::dvec3(0.0);
    const glm::dvec3 y = -(glm::inverse(q.a + damping * glm::dmat3(1.0)) * (q.a * middle + q.b));
    const double reach = 0.5 * glm::length(edge);
    const double distance = glm::length(y);
    return distance > reach ? y * (reach / distance) : y;
  }

  Placement placement_;
  glm::dvec3 origin_{0.0};
  Array<FullQuadric> quadrics_;
};

}  // namespace

bool follows_attributes(const SimplifyOptions& options) {
  return counts_attributes(options) && options.metric != nullptr && options.metric->size > 0;
}

std::unique_ptr<CollapsePolicy> make_policy(const SimplifyOptions& options,
                                            const Surface& surface) {
  const Placement placement = options.placement;
  switch (options.cost) {
    case CostPolicy::accumulated_quadric:
      return std::make_unique<AccumulatedPolicy>(placement, surface);
    case CostPolicy::edge_length:
      return std::make_unique<LengthPolicy>(placement);
    case CostPolicy::shape:
      return std::make_unique<ShapePolicy>(placement);
    case CostPolicy::random:
      return std::make_unique<RandomPolicy>(placement, options.seed);
    case CostPolicy::quadric:
      break;
  }
  if (follows_attributes(options)) {
    return std::make_unique<AttributePolicy>(placement, surface, *options.metric);
  }
  return std::make_unique<QuadricPolicy>(placement);
}

}  // namespace mesher::simplify
