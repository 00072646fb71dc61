#include "engine/simplify/surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/mesh/circulators.h"
#include "engine/simplify/cost_policy.h"
#include "engine/simplify/seams.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kSurfaceGrain = 1U << 12;
constexpr std::size_t kSurfaceChunk = 1U << 16;
/// Most feature edges that are counted at a vertex.
constexpr std::uint8_t kMostFeatures = std::numeric_limits<std::uint8_t>::max();

VertexConstraint constraint_of(int feature_edges) {
  if (feature_edges == 0) return VertexConstraint::free;
  return feature_edges == 2 ? VertexConstraint::line : VertexConstraint::corner;
}

AllowedPlacement placement_of(VertexConstraint from, VertexConstraint to, bool is_feature) {
  if (from == VertexConstraint::free && to == VertexConstraint::free)
    return AllowedPlacement::anywhere;
  if (from == VertexConstraint::free) return AllowedPlacement::at_target;
  if (to == VertexConstraint::free) return AllowedPlacement::at_origin;
  if (!is_feature || (from == VertexConstraint::corner && to == VertexConstraint::corner))
    return AllowedPlacement::nowhere;
  if (to == VertexConstraint::corner) return AllowedPlacement::at_target;
  return from == VertexConstraint::corner ? AllowedPlacement::at_origin
                                          : AllowedPlacement::anywhere;
}

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

Surface::Surface(Mesh&& mesh, const SimplifyOptions& options)
    : mesh_(std::move(mesh)), crosses_seams_(options.crosses_seams && follows_attributes(options)) {
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

/// Returns the shape of the face's current corners.
FaceShape Surface::shape_of(Face f) const {
  const auto corner = [&](std::uint32_t c) {
    const glm::vec3& p = mesh_.position(mesh_.origin(Mesh::halfedge(f, c)));
    return Vec3<float>{p.x, p.y, p.z};
  };
  const auto [unit, area] = unit_and_area(corner(1) - corner(0), corner(2) - corner(0));
  return {{unit.x, unit.y, unit.z}, area};
}

void Surface::find_shapes() {
  faces_.resize(mesh_.face_count());
  refused_.resize(mesh_.face_count());
  area_before_ = parallel_sum<double>(mesh_.face_count(), kSurfaceGrain, [&](IndexRange range) {
    double sum = 0.0;
    for (std::size_t f = range.begin; f < range.end; ++f) {
      const FaceShape shape = shape_of(Face(static_cast<std::uint32_t>(f)));
      faces_[f] = {.shape = shape, .first_normal = pack(shape.normal)};
      refused_[f] = 0;
      sum += double{shape.area};
    }
    return sum;
  });
}

void Surface::find_features(const SimplifyOptions& options) {
  const float least_cosine = std::cos(glm::radians(options.crease_angle_deg));
  const bool by_angle = options.crease_angle_deg < 180.0F;
  const auto is_crease = [&](Halfedge h) {
    return by_angle && glm::dot(shape(Mesh::face(h)).normal,
                                shape(Mesh::face(mesh_.twin(h))).normal) < least_cosine;
  };
  const auto kind = [&](Halfedge h) {
    if (!mesh_.twin(h).is_valid()) return EdgeKind::feature;
    if (crosses_seams_ && mesh_.sharpness(h) == kSeamSharpness)
      return is_crease(h) ? EdgeKind::feature : EdgeKind::seam;
    return mesh_.sharpness(h) > 0.0F || is_crease(h) ? EdgeKind::feature : EdgeKind::smooth;
  };
  feature_.resize(mesh_.halfedge_count());
  struct Counts {
    std::uint64_t features = 0;
    std::uint64_t seams = 0;
    Counts& operator+=(const Counts& by) {
      features += by.features;
      seams += by.seams;
      return *this;
    }
  };
  const auto counts =
      parallel_sum<Counts>(mesh_.halfedge_count(), kSurfaceChunk, [&](IndexRange range) {
        Counts sum;
        for (std::size_t i = range.begin; i < range.end; ++i) {
          feature_[i] = kind(Halfedge(static_cast<std::uint32_t>(i)));
          sum.features += feature_[i] != EdgeKind::smooth ? 1 : 0;
          sum.seams += feature_[i] == EdgeKind::seam ? 1 : 0;
        }
        return sum;
      });
  has_features_ = counts.features > 0;
  has_seams_ = counts.seams > 0;
  // Most scans are smooth and closed, so nothing is stored for them.
  if (!has_features_) feature_ = {};
}

void Surface::find_constraints(const SimplifyOptions& options) {
  const bool has_own = !mesh_.vertex_sharpnesses().empty();
  is_constrained_ = has_features_ || has_own || !mesh_.bow_tie_copies().empty();
  if (!is_constrained_) return;
  // Features are few, so one pass over them replaces a rotation around every vertex.
  struct Met {
    std::uint8_t all = 0;
    std::uint8_t seams = 0;
  };
  Array<Met> features(has_features_ ? mesh_.vertex_count() : 0);
  const auto count = [&](Vertex v, bool is_seam) {
    Met& met = features[v.index()];
    if (met.all == kMostFeatures) return;
    ++met.all;
    if (is_seam) ++met.seams;
  };
  for (std::uint32_t i = 0; i < mesh_.halfedge_count() && has_features_; ++i) {
    const Halfedge h(i);
    if (!is_feature(h) || !(h < mesh_.twin(h))) continue;
    for (const Vertex v : {mesh_.origin(h), mesh_.target(h)})
      count(v, kind(h) == EdgeKind::seam);
  }
  const bool locks = options.boundary == BoundaryRule::lock;
  parallel_for_each(mesh_.vertex_count(), kSurfaceGrain, [&](std::uint32_t i) {
    const Vertex v(i);
    const Met met = has_features_ ? features[i] : Met{};
    const bool is_fixed =
        (has_own && mesh_.sharpness(v) > 0.0F) || (locks && met.all > 0 && mesh_.is_boundary(v));
    const auto constraint = [&](int edges) {
      return is_fixed ? VertexConstraint::corner : constraint_of(edges);
    };
    vertices_[i].constraint = constraint(met.all);
    vertices_[i].constraint_across = constraint(met.all - met.seams);
  });
  for (const BowTieCopy& copy : mesh_.bow_tie_copies()) {
    VertexState& fixed = vertices_[copy.v.index()];
    fixed.constraint = fixed.constraint_across = VertexConstraint::corner;
  }
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
  Quadric<float> q = plane_quadric(Vec3<float>{out.x, out.y, out.z}, feature_weight(h));
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
  const AllowedPlacement along = placement_of(from, to, is_feature(h));
  if (!crosses_seams_) return along;
  const bool must_cross = along == AllowedPlacement::nowhere || is_in_loop(h, EdgeKind::seam);
  return must_cross && ends_across(h) != AllowedPlacement::nowhere ? AllowedPlacement::across
                                                                   : along;
}

AllowedPlacement Surface::ends_across(Halfedge h) const {
  return placement_of(state(mesh_.origin(h)).constraint_across,
                      state(mesh_.target(h)).constraint_across, kind(h) == EdgeKind::feature);
}

bool Surface::is_in_loop(Halfedge h, EdgeKind least) const {
  if (kind(h) < least) return false;
  for (const Halfedge side : {h, mesh_.twin(h)}) {
    if (side.is_valid() && kind(Mesh::next(side)) >= least && kind(Mesh::prev(side)) >= least)
      return true;
  }
  return false;
}

void Surface::free_seams() {
  seam_weight_ = kFreeSeamWeight;
  for (VertexState& s : vertices_) {
    if (s.region == VertexState::kGone) continue;
    s.best = {};
    s.cost = kNever;
  }
  for (FaceState& face : faces_)
    face.cost = {kNever, kNever, kNever};
  sum_quadrics();
}

void Surface::recompute() {
  parallel_for_each(mesh_.face_count(), kSurfaceGrain, [&](std::uint32_t i) {
    if (!is_removed(Face(i))) faces_[i].shape = shape_of(Face(i));
  });
  sum_quadrics();
}

/// Computes the quadrics from the shapes.
void Surface::sum_quadrics() {
  for (VertexState& s : vertices_) {
    if (s.region != VertexState::kGone) s.quadric = {};
  }
  for (std::uint32_t i = 0; i < mesh_.face_count(); ++i) {
    const Face f(i);
    if (is_removed(f)) continue;
    const std::array<Quadric<float>, 3> added = contributions(f);
    for (std::uint32_t c = 0; c < 3; ++c) {
      Quadric<float>& sum = state(mesh_.origin(Mesh::halfedge(f, c))).quadric;
      sum = sum + added[c];
    }
  }
}

void Surface::update_constraint(Vertex v) {
  int features = 0;
  for (const Halfedge h : halfedges_around(mesh_, v)) {
    features += is_feature(h) ? 1 : 0;
    features += mesh_.twin(Mesh::prev(h)).is_valid() ? 0 : 1;
  }
  state(v).constraint = std::max(constraint_of(features), state(v).constraint_across);
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
