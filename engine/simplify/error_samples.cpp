#include "engine/simplify/error_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/analysis/triangle_tree.h"
#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher {
namespace {

constexpr std::size_t kGrain = 64;
// A walk that is longer has gone astray.
constexpr int kMostSteps = 64;
// Of a hub no more faces are looked at.
constexpr int kMostFaces = 256;

double fraction(double x) {
  return x - std::floor(x);
}

/// The i-th of points that fill a triangle evenly (M. Roberts, "The unreasonable effectiveness of
/// quasirandom sequences", 2018).
glm::dvec3 point_in_face(const Mesh& mesh, Face f, std::size_t i) {
  const auto corner = [&](std::uint32_t c) {
    return glm::dvec3(mesh.position(mesh.origin(Mesh::halfedge(f, c))));
  };
  const double u = std::sqrt(fraction(0.5 + 0.7548776662466927 * static_cast<double>(i)));
  const double v = fraction(0.5 + 0.5698402909980532 * static_cast<double>(i));
  return (1.0 - u) * corner(0) + u * (1.0 - v) * corner(1) + u * v * corner(2);
}

/// The vertex that stands for `v` now; none where its faces are gone.
Vertex survivor(const Surface& surface, Vertex v) {
  while (surface.state(v).region == VertexState::kGone)
    v = surface.state(v).merged_into();
  return v;
}

/// Walks from vertex to vertex as long as the faces around come nearer to the point.
double squared_distance_from(const Surface& surface, Vertex start, const glm::dvec3& p) {
  const Mesh& mesh = surface.mesh();
  double least = std::numeric_limits<double>::infinity();
  Face nearest;
  const auto visit = [&](Vertex v) {
    int faces = 0;
    for (const Halfedge h : halfedges_around(mesh, v)) {
      if (++faces > kMostFaces) break;
      const auto corner = [&](Halfedge s) { return glm::dvec3(mesh.position(mesh.origin(s))); };
      const double d =
          squared_distance(p, {corner(h), corner(Mesh::next(h)), corner(Mesh::prev(h))});
      if (d >= least) continue;
      least = d;
      nearest = Mesh::face(h);
    }
  };
  visit(start);
  for (int step = 0; step < kMostSteps && nearest.is_valid(); ++step) {
    const double before = least;
    const Face from = nearest;
    for (std::uint32_t c = 0; c < 3; ++c)
      visit(mesh.origin(Mesh::halfedge(from, c)));
    if (least >= before) break;
  }
  return least;
}

}  // namespace

ErrorSamples::ErrorSamples(const Surface& surface, std::size_t count) {
  const Mesh& mesh = surface.mesh();
  const double step = surface.area_before() / static_cast<double>(count);
  if (!(step > 0.0) || !std::isfinite(step)) return;
  samples_.reserve(count + 1);
  double area = 0.0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    area += double{surface.shape(Face(f)).area};
    while (samples_.size() < count && (static_cast<double>(samples_.size()) + 0.5) * step < area) {
      samples_.push_back(
          {point_in_face(mesh, Face(f), samples_.size()), mesh.origin(Mesh::halfedge(Face(f)))});
    }
  }
}

ErrorSamples::Measured ErrorSamples::measure(const Surface& surface) const {
  struct Sums {
    double squares = 0.0;
    double fourths = 0.0;
    Sums& operator+=(const Sums& other) {
      squares += other.squares;
      fourths += other.fourths;
      return *this;
    }
  };
  if (samples_.empty()) return {};
  const Sums sums = parallel_sum<Sums>(samples_.size(), kGrain, [&](IndexRange range) {
    Sums part;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Vertex start = survivor(surface, samples_[i].corner);
      if (surface.mesh().is_isolated(start)) continue;
      const double square = squared_distance_from(surface, start, samples_[i].point);
      part += {square, square * square};
    }
    return part;
  });
  const double n = static_cast<double>(samples_.size());
  const double mean = sums.squares / n;
  if (!(mean > 0.0)) return {0.0, 1.0};
  return {mean, std::max(sums.fourths / n / (mean * mean) - 1.0, 0.0) / n};
}

}  // namespace mesher
