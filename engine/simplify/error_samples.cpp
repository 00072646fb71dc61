#include "engine/simplify/error_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"
#include "engine/simplify/triangle_lanes.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kSampleGrain = 64;
// A longer walk has lost its way.
constexpr int kMostSteps = 64;
// Maximum number of faces visited at a vertex, so that hubs stay cheap.
constexpr int kMostWalkedFaces = 256;

double fraction(double x) {
  return x - std::floor(x);
}

/// Returns the i-th point of a sequence that covers a triangle evenly (M. Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018).
glm::dvec3 point_in_face(const Mesh& mesh, Face f, std::size_t i) {
  const auto corner = [&](std::uint32_t c) {
    return glm::dvec3(mesh.position(mesh.origin(Mesh::halfedge(f, c))));
  };
  const double u = std::sqrt(fraction(0.5 + 0.7548776662466927 * static_cast<double>(i)));
  const double v = fraction(0.5 + 0.5698402909980532 * static_cast<double>(i));
  return (1.0 - u) * corner(0) + u * (1.0 - v) * corner(1) + u * v * corner(2);
}

/// Returns the vertex into which `v` was merged; it is isolated if its faces are removed.
Vertex survivor(const Surface& surface, Vertex v) {
  while (surface.state(v).region == VertexState::kGone)
    v = surface.state(v).merged_into();
  return v;
}

/// Walks from vertex to vertex while the faces around get closer to a point.
class Walk {
 public:
  Walk(const Surface& surface, const glm::dvec3& p) : mesh_(surface.mesh()), p_(p) {}

  ErrorSamples::Nearest from(Vertex start) {
    visit(start);
    Vertex last = start;
    for (int step = 0; step < kMostSteps && nearest_.is_valid(); ++step) {
      const float before = least_;
      const Halfedge from = nearest_;
      for (const Halfedge corner : {from, Mesh::next(from), Mesh::prev(from)}) {
        if (mesh_.origin(corner) != last) visit(mesh_.origin(corner));
      }
      // The half-edge of the nearest face starts at the vertex where it was found.
      last = mesh_.origin(nearest_);
      if (least_ >= before) break;
    }
    if (!nearest_.is_valid()) return {};
    return {Mesh::face(nearest_), least_};
  }

 private:
  Vec3<float> from_point(Vertex v) const {
    const glm::vec3 d(glm::dvec3(mesh_.position(v)) - p_);
    return {d.x, d.y, d.z};
  }

  /// Measures the faces around a vertex, four at a time.
  void visit(Vertex v) {
    std::array<Halfedge, 4> four;
    std::size_t count = 0;
    int faces = 0;
    for (const Halfedge h : halfedges_around(mesh_, v)) {
      if (++faces > kMostWalkedFaces) break;
      four[count++] = h;
      if (count == 4) look_at(v, four, std::exchange(count, 0));
    }
    if (count > 0) look_at(v, four, count);
  }

  void look_at(Vertex v, const std::array<Halfedge, 4>& faces, std::size_t count) {
    TriangleLanes triangles{in_all_lanes(from_point(v)), {}, {}};
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const Halfedge h = faces[std::min(lane, count - 1)];
      set_lane(triangles.b, lane, from_point(mesh_.target(h)));
      set_lane(triangles.c, lane, from_point(mesh_.origin(Mesh::prev(h))));
    }
    const Float4 squares = squared_distances(in_all_lanes({0.0F, 0.0F, 0.0F}), triangles);
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (!(squares[lane] < least_)) continue;
      least_ = squares[lane];
      nearest_ = faces[lane];
    }
  }

  const Mesh& mesh_;
  glm::dvec3 p_;
  float least_ = std::numeric_limits<float>::infinity();
  Halfedge nearest_;
};

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

ErrorSamples::Nearest ErrorSamples::nearest(const Surface& surface, std::size_t i) const {
  const Vertex start = survivor(surface, samples_[i].corner);
  if (surface.mesh().is_isolated(start)) return {};
  return Walk(surface, samples_[i].point).from(start);
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
  const Sums sums = parallel_sum<Sums>(samples_.size(), kSampleGrain, [&](IndexRange range) {
    Sums part;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const double square{nearest(surface, i).squared_distance};
      part += {square, square * square};
    }
    return part;
  });
  const double n = static_cast<double>(samples_.size());
  const double mean = sums.squares / n;
  if (!(mean > 0.0)) return {0.0, 1.0};
  return {mean, std::max(sums.fourths / n / (mean * mean) - 1.0, 0.0) / n};
}

}  // namespace mesher::simplify
