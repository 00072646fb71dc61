#include "engine/analysis/surface_matches.h"

#include <cmath>

#include "engine/analysis/surface_samples.h"
#include "engine/core/parallel.h"
#include "engine/mesh/statistics.h"

namespace mesher::analysis {
namespace {

// Faces; few, because each of a coarse mesh has many samples.
constexpr std::size_t kMatchChunk = 128;

/// The matches of one chunk of faces.
struct Found {
  std::vector<SurfacePoint> samples;
  std::vector<SurfacePoint> candidates;
  std::vector<std::uint32_t> counts;  ///< candidates of each sample
};

}  // namespace

double equally_near(const Mesh& mesh) {
  return 1e-6 * bounding_box(mesh).diagonal();
}

std::span<const SurfacePoint> NearestPoints::nearest(const glm::dvec3& position) {
  const TriangleTree::Nearest nearest = tree_.nearest(position, hint_);
  hint_ = nearest.face;
  const double reach = std::sqrt(nearest.squared_distance) + tolerance_;
  faces_.clear();
  tree_.within(position, reach * reach, kMostCandidates, faces_);
  if (faces_.empty()) faces_.push_back(nearest.face);
  points_.clear();
  for (const Face f : faces_)
    points_.push_back({f, glm::vec3(nearest_weights(position, tree_.triangle(f)))});
  return points_;
}

SurfaceMatches match_surfaces(const Mesh& from, const Mesh& to, const TriangleTree& tree,
                              std::uint64_t samples, Progress* progress) {
  MESHER_ASSERT(from.face_count() > 0 && to.face_count() > 0);
  const SurfaceSamples points(from, samples);
  const double tolerance = equally_near(to);
  std::vector<Found> chunks(chunk_count(from.face_count(), kMatchChunk));
  parallel_chunks(from.face_count(), kMatchChunk, progress, [&](std::size_t c, IndexRange faces) {
    NearestPoints finder(tree, tolerance);
    Found& found = chunks[c];
    for (std::size_t f = faces.begin; f < faces.end; ++f) {
      for (std::uint64_t i = points.begin(f); i < points.begin(f + 1); ++i) {
        const auto nearest = finder.nearest(points.position(f, i));
        found.samples.push_back(
            {Face(static_cast<std::uint32_t>(f)), glm::vec3(SurfaceSamples::weights(i))});
        found.candidates.insert(found.candidates.end(), nearest.begin(), nearest.end());
        found.counts.push_back(static_cast<std::uint32_t>(nearest.size()));
      }
    }
  });
  SurfaceMatches matches;
  matches.samples_.reserve(points.count());
  matches.first_.reserve(points.count() + 1);
  matches.first_.push_back(0);
  for (Found& chunk : chunks) {
    matches.samples_.insert(matches.samples_.end(), chunk.samples.begin(), chunk.samples.end());
    matches.candidates_.insert(matches.candidates_.end(), chunk.candidates.begin(),
                               chunk.candidates.end());
    for (const std::uint32_t count : chunk.counts)
      matches.first_.push_back(matches.first_.back() + count);
    chunk = {};
  }
  return matches;
}

}  // namespace mesher::analysis
