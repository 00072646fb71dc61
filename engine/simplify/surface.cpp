#include "engine/simplify/surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/mesh/circulators.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kSurfaceGrain = 1U << 12;
constexpr std::size_t kSurfaceChunk = 1U << 16;
// Weight of a feature edge, relative to a face whose area is its squared length: large enough that
// boundaries are straightened last, small enough that their surroundings still count.
constexpr float kFeatureWeight = 1.0F;

/// Packs three components of ten bits.
std::uint32_t pack(const glm::vec3& unit) {
  const auto bits = [](float x) {
    return static_cast<std::uint32_t>(
               static_cast<std::int32_t>(x * 511.0F + (x < 0 ? -0.5F : 0.5F))) &
           0x3FFU;
  };
  return bits(unit.x) | bits(unit.y) << 10U | bits(unit.z) << 20U;
}

}  // namespace

Surface::Surface(Mesh&& mesh, const SimplifyOptions& options) : mesh_(std::move(mesh)) {
  // The whole mesh will change, so recording ranges would be wasted work.
  mesh_.changes().note_all();
  find_shapes();
  check_cancelled(options.progress);
  find_features(options);
  check_cancelled(options.progress);
  find_states();
  check_cancelled(options.progress);
  find_constraints(options);
}

bool Surface::note_refused(Halfedge h) {
  const auto has_bit = [&](Halfedge half) {
    return (refused_[Mesh::face(half).index()] >> Mesh::corner(half) & 1U) != 0;
  };
  const Halfedge t = mesh_.twin(h);
  const bool is_new = !has_bit(h) && (!t.is_valid() || !has_bit(t));
  refused_[Mesh::face(h).index()] |= static_cast<std::uint8_t>(1U << Mesh::corner(h));
  return is_new;
}

void Surface::find_shapes() {
  faces_.resize(mesh_.face_count());
  refused_.resize(mesh_.face_count());
  area_before_ = parallel_sum<double>(mesh_.face_count(), kSurfaceGrain, [&](IndexRange range) {
    double sum = 0.0;
    for (std::size_t f = range.begin; f < range.end; ++f) {
      const auto corner = [&](std::size_t c) {
        const Halfedge h(static_cast<std::uint32_t>(3 * f + c));
        const glm::vec3& p = mesh_.position(mesh_.origin(h));
        return Vec3<float>{p.x, p.y, p.z};
      };
      const auto [unit, area] = unit_and_area(corner(1) - corner(0), corner(2) - corner(0));
      const FaceShape shape{{unit.x, unit.y, unit.z}, area};
      faces_[f] = {.shape = shape, .first_normal = pack(shape.normal)};
      refused_[f] = 0;
      sum += double{area};
    }
    return sum;
  });
}

void Surface::find_features(const SimplifyOptions& options) {
  const float least_cosine = std::cos(glm::radians(options.crease_angle_deg));
  const bool by_angle = options.crease_angle_deg < 180.0F;
  const auto is_feature = [&](Halfedge h) {
    const Halfedge t = mesh_.twin(h);
    if (!t.is_valid() || mesh_.sharpness(h) > 0.0F) return true;
    return by_angle &&
           glm::dot(shape(Mesh::face(h)).normal, shape(Mesh::face(t)).normal) < least_cosine;
  };
  feature_.resize(mesh_.halfedge_count());
  has_features_ =
      parallel_sum<std::uint64_t>(mesh_.halfedge_count(), kSurfaceChunk, [&](IndexRange range) {
        std::uint64_t count = 0;
        for (std::size_t i = range.begin; i < range.end; ++i) {
          feature_[i] = is_feature(Halfedge(static_cast<std::uint32_t>(i))) ? 1 : 0;
          count += feature_[i];
        }
        return count;
      }) > 0;
  // Most scans are smooth and closed, so nothing is stored for them.
  if (!has_features_) feature_ = {};
}

void Surface::find_constraints(const SimplifyOptions& options) {
  const bool has_own = !mesh_.vertex_sharpnesses().empty();
  is_constrained_ = has_features_ || has_own || !mesh_.bow_tie_copies().empty();
  if (!is_constrained_) return;
  // Features are few, so one pass over them replaces a rotation around every vertex.
  Array<std::uint8_t> features(has_features_ ? mesh_.vertex_count() : 0);
  std::fill(features.begin(), features.end(), std::uint8_t{0});
  const auto count = [&](Vertex v) {
    if (features[v.index()] < 3) ++features[v.index()];
  };
  for (std::uint32_t i = 0; i < mesh_.halfedge_count() && has_features_; ++i) {
    const Halfedge h(i);
    if (feature_[i] == 0 || !(h < mesh_.twin(h))) continue;
    count(mesh_.origin(h));
    count(mesh_.target(h));
  }
  const bool locks = options.boundary == BoundaryRule::lock;
  parallel_for_each(mesh_.vertex_count(), kSurfaceGrain, [&](std::uint32_t i) {
    const Vertex v(i);
    const int met = has_features_ ? features[i] : 0;
    const bool is_fixed =
        (has_own && mesh_.sharpness(v) > 0.0F) || (locks && met > 0 && mesh_.is_boundary(v));
    if (is_fixed || met == 1 || met > 2) {
      vertices_[i].constraint = VertexConstraint::corner;
    } else if (met == 2) {
      vertices_[i].constraint = VertexConstraint::line;
    }
  });
  for (const BowTieCopy& copy : mesh_.bow_tie_copies())
    vertices_[copy.v.index()].constraint = VertexConstraint::corner;
}

void Surface::find_states() {
  vertices_.resize(mesh_.vertex_count());
  parallel_for_each(mesh_.vertex_count(), kSurfaceGrain, [&](std::uint32_t i) {
    const Vertex v(i);
    const glm::vec3& p = mesh_.position(v);
    state(v) = VertexState{};
    state(v).position = {p.x, p.y, p.z};
    QuadricRows sum{};
    for (const Halfedge h : halfedges_around(mesh_, v)) {
      const Face f = Mesh::face(h);
      sum = sum + plane_rows(shape_row(f));
      if (has_feature(f)) add_features(h);
    }
    add(v, sum);
  });
}

/// Adds the contribution of the face's feature edges to its corner at origin(h).
void Surface::add_features(Halfedge h) {
  Quadric<float>& sum = state(mesh_.origin(h)).quadric;
  for (const Halfedge side : {h, Mesh::prev(h)}) {
    if (is_feature(side)) sum = sum + across_quadric(side);
  }
}

glm::vec3 Surface::across(Halfedge h) const {
  const glm::vec3 edge = mesh_.position(mesh_.target(h)) - mesh_.position(mesh_.origin(h));
  // The normal is a unit vector perpendicular to the edge, so the product is as long as the edge.
  return glm::cross(edge, shape(Mesh::face(h)).normal);
}

/// Returns the quadric of a plane through a feature edge, perpendicular to the face of `h`; it
/// sweeps no volume.
Quadric<float> Surface::across_quadric(Halfedge h) const {
  const glm::vec3 out = across(h);
  Quadric<float> q = plane_quadric(Vec3<float>{out.x, out.y, out.z}, kFeatureWeight);
  q.g = {};
  return q;
}

std::array<Quadric<float>, 3> Surface::contributions(Face f) const {
  const Quadric<float> plane = plane_quadric(shape(f));
  std::array<Quadric<float>, 3> result{plane, plane, plane};
  if (!has_feature(f)) return result;
  for (std::uint32_t c = 0; c < 3; ++c) {
    const Halfedge h = Mesh::halfedge(f, c);
    if (!is_feature(h)) continue;
    const Quadric<float> q = across_quadric(h);
    result[c] = result[c] + q;
    result[(c + 1) % 3] = result[(c + 1) % 3] + q;
  }
  return result;
}

AllowedPlacement Surface::constrained_placement(Halfedge h, VertexConstraint from,
                                                VertexConstraint to) const {
  if (from == VertexConstraint::free) return AllowedPlacement::at_target;
  if (to == VertexConstraint::free) return AllowedPlacement::at_origin;
  if (!is_feature(h) || (from == VertexConstraint::corner && to == VertexConstraint::corner)) {
    return AllowedPlacement::nowhere;
  }
  if (to == VertexConstraint::corner) return AllowedPlacement::at_target;
  return from == VertexConstraint::corner ? AllowedPlacement::at_origin
                                          : AllowedPlacement::anywhere;
}

EdgeQuadric<Float8> Surface::edge_quadrics(const std::array<Halfedge, 8>& edges) const {
  std::array<std::array<Face, 4>, 2> left;
  std::array<std::array<Face, 4>, 2> right;
  for (std::size_t lane = 0; lane < 8; ++lane) {
    left[lane / 4][lane % 4] = Mesh::face(edges[lane]);
    right[lane / 4][lane % 4] = Mesh::face(mesh_.twin(edges[lane]));
  }
  const auto area_vectors = [&](const std::array<std::array<Face, 4>, 2>& faces) {
    const ShapeLanes low = shapes(faces[0]);
    const ShapeLanes high = shapes(faces[1]);
    return pair(low.normal, high.normal) * Float8{low.area, high.area};
  };
  const auto [from, to] = ends(edges);
  return {from.quadric, to.quadric, area_vectors(left) + area_vectors(right),
          to.position - from.position};
}

}  // namespace mesher::simplify
