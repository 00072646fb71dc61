#include "engine/analysis/distance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/analysis/triangle_tree.h"
#include "engine/core/parallel.h"
#include "engine/mesh/statistics.h"

namespace mesher::analysis {
namespace {

constexpr std::size_t kChunk = 2048;

struct Sums {
  double squared = 0.0;
  double distance = 0.0;
  double max = 0.0;
  std::uint64_t samples = 0;

  void add(double squared_distance) {
    squared += squared_distance;
    distance += std::sqrt(squared_distance);
    max = std::max(max, std::sqrt(squared_distance));
    ++samples;
  }
  Sums& operator+=(const Sums& other) {
    squared += other.squared;
    distance += other.distance;
    max = std::max(max, other.max);
    samples += other.samples;
    return *this;
  }
};

glm::dvec3 corner(const Mesh& mesh, std::size_t face, std::uint32_t c) {
  return mesh.position(mesh.origin(Mesh::halfedge(Face(static_cast<std::uint32_t>(face)), c)));
}

double area(const Mesh& mesh, std::size_t face) {
  const glm::dvec3 a = corner(mesh, face, 0);
  return 0.5 * glm::length(glm::cross(corner(mesh, face, 1) - a, corner(mesh, face, 2) - a));
}

/// Returns the total area of the faces before each face; one entry more than faces.
std::vector<double> area_before(const Mesh& mesh) {
  std::vector<double> before(std::size_t{mesh.face_count()} + 1, 0.0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    before[f + 1] = before[f] + area(mesh, f);
  return before;
}

double fraction(double x) {
  return x - std::floor(x);
}

/// Returns the i-th point of a sequence that fills a triangle evenly (M. Roberts, "The unreasonable
/// effectiveness of quasirandom sequences", 2018: powers of the plastic number).
glm::dvec3 point_in_triangle(const Mesh& mesh, std::size_t face, std::uint64_t i) {
  const double u = std::sqrt(fraction(0.5 + 0.7548776662466927 * static_cast<double>(i)));
  const double v = fraction(0.5 + 0.5698402909980532 * static_cast<double>(i));
  return (1.0 - u) * corner(mesh, face, 0) + u * (1.0 - v) * corner(mesh, face, 1) +
         u * v * corner(mesh, face, 2);
}

/// Each face gets the samples whose position along the cumulative area falls into it.
Sums sample_faces(const Mesh& from, const TriangleTree& to, const DistanceOptions& options) {
  const std::vector<double> before = area_before(from);
  const double per_area =
      before.back() > 0.0 ? static_cast<double>(options.samples) / before.back() : 0.0;
  const auto sample_at = [&](std::size_t f) {
    return static_cast<std::uint64_t>(before[f] * per_area);
  };
  return parallel_sum<Sums>(from.face_count(), kChunk, options.progress, [&](IndexRange faces) {
    Sums sums;
    Face hint(0);
    for (std::size_t f = faces.begin; f < faces.end; ++f) {
      for (std::uint64_t i = sample_at(f); i < sample_at(f + 1); ++i) {
        const TriangleTree::Nearest hit = to.nearest(point_in_triangle(from, f, i), hint);
        hint = hit.face;
        sums.add(hit.squared_distance);
      }
    }
    return sums;
  });
}

double farthest_vertex(const Mesh& from, const TriangleTree& to, Progress* progress) {
  return parallel_sum<Sums>(from.vertex_count(), kChunk, progress,
                            [&](IndexRange vertices) {
                              Sums sums;
                              Face hint(0);
                              for (std::size_t v = vertices.begin; v < vertices.end; ++v) {
                                const Vertex vertex(static_cast<std::uint32_t>(v));
                                if (from.is_isolated(vertex)) continue;
                                const TriangleTree::Nearest hit =
                                    to.nearest(from.position(vertex), hint);
                                hint = hit.face;
                                sums.add(hit.squared_distance);
                              }
                              return sums;
                            })
      .max;
}

OneSidedDistance one_sided(const Mesh& from, const TriangleTree& to,
                           const DistanceOptions& options) {
  // A sample and a vertex take about the same time.
  Stages stages(options.progress,
                {static_cast<double>(options.samples), static_cast<double>(from.vertex_count())});
  stages.next();
  const Sums sums = sample_faces(from, to, options);
  stages.next();
  const double n = static_cast<double>(std::max<std::uint64_t>(sums.samples, 1));
  return {.rms = std::sqrt(sums.squared / n),
          .mean = sums.distance / n,
          .max = std::max(sums.max, farthest_vertex(from, to, options.progress))};
}

}  // namespace

OneSidedDistance SurfaceDistance::two_sided() const {
  return {.rms = std::max(forward.rms, backward.rms),
          .mean = std::max(forward.mean, backward.mean),
          .max = std::max(forward.max, backward.max)};
}

SurfaceDistance surface_distance(const Mesh& a, const Mesh& b, const DistanceOptions& options) {
  MESHER_ASSERT(a.face_count() > 0 && b.face_count() > 0);
  SurfaceDistance distance;
  distance.diagonal = bounding_box(a).diagonal();
  Stages stages(options.progress, {1.0, 1.0});
  stages.next("measuring from the first to the second");
  distance.forward = one_sided(a, TriangleTree(b), options);
  stages.next("measuring from the second to the first");
  distance.backward = one_sided(b, TriangleTree(a), options);
  return distance;
}

}  // namespace mesher::analysis
