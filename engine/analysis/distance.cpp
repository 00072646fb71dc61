#include "engine/analysis/distance.h"

#include <algorithm>
#include <cmath>

#include "engine/analysis/surface_samples.h"
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

Sums sample_faces(const Mesh& from, const TriangleTree& to, const DistanceOptions& options) {
  const SurfaceSamples samples(from, options.samples);
  return parallel_sum<Sums>(from.face_count(), kChunk, options.progress, [&](IndexRange faces) {
    Sums sums;
    Face hint(0);
    for (std::size_t f = faces.begin; f < faces.end; ++f) {
      for (std::uint64_t i = samples.begin(f); i < samples.begin(f + 1); ++i) {
        const TriangleTree::Nearest hit = to.nearest(samples.position(f, i), hint);
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
