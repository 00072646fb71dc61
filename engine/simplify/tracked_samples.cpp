#include "engine/simplify/tracked_samples.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/simplify/triangle_lanes.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kTrackedGrain = 64;
// With this many points, they weigh as much as the planes.
constexpr float kTrustInPlanes = 8.0F;

}  // namespace

TrackedSamples::TrackedSamples(const Surface& surface, const ErrorSamples& samples)
    : samples_(&samples), first_(surface.mesh().face_count(), kNone), points_(samples.size()) {
  if (samples.size() == 0) return;
  weight_ = kTimesCounted * surface.area_before() / static_cast<double>(samples.size());
  std::vector<Face> faces(samples.size());
  parallel_for(samples.size(), kTrackedGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const ErrorSamples::Nearest nearest = samples.nearest(surface, i);
      faces[i] = nearest.face;
      points_[i].squared_distance = nearest.squared_distance;
    }
  });
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    if (faces[i].is_valid()) points_[i].next = std::exchange(first_[faces[i].index()], i);
  }
}

/// Finds the new face and distance of each point of a face.
void TrackedSamples::find_moved(Face f, const Fan& fan, const glm::vec3& p) {
  const Vec3<Float4> origin = in_all_lanes({0.0F, 0.0F, 0.0F});
  for (std::uint32_t s = first_[f.index()]; s != kNone; s = points_[s].next) {
    const glm::dvec3& point = samples_->point(s);
    // Differences in double, so that no precision is lost far from the model's origin.
    const glm::vec3 to_center(glm::dvec3(p) - point);
    const Vec3<Float4> center = in_all_lanes({to_center.x, to_center.y, to_center.z});
    const Vec3<Float4> back = center - in_all_lanes({p.x, p.y, p.z});
    Moved moved{s, {}, std::numeric_limits<float>::infinity()};
    for (std::size_t i = 0; i < fan.size(); i += 4) {
      const Float4 squares = squared_distances(
          origin, {center, fan.four_positions(i) + back, fan.four_positions(i + 1) + back});
      for (std::size_t lane = 0; lane < 4 && i + lane < fan.size(); ++lane) {
        if (!(squares[lane] < moved.squared_distance)) continue;
        moved.squared_distance = squares[lane];
        moved.face = Mesh::face(fan.spokes()[i + lane]);
      }
    }
    before_ += double{points_[s].squared_distance};
    moved_.push_back(moved);
  }
}

float TrackedSamples::correction(const Surface& surface, Halfedge h, const Fan& fan,
                                 const glm::vec3& p, float estimate) {
  moved_.clear();
  before_ = 0.0;
  find_moved(Mesh::face(h), fan, p);
  if (const Halfedge t = surface.mesh().twin(h); t.is_valid()) {
    find_moved(Mesh::face(t), fan, p);
  }
  for (const Halfedge spoke : fan.spokes())
    find_moved(Mesh::face(spoke), fan, p);
  double after = 0.0;
  for (const Moved& moved : moved_)
    after += double{moved.squared_distance};
  const auto count = static_cast<float>(moved_.size());
  const auto measured = static_cast<float>(std::max(weight_ * (after - before_), 0.0));
  return count / (count + kTrustInPlanes) * (measured - estimate);
}

void TrackedSamples::collapsed(const Fan& fan) {
  for (const Halfedge spoke : fan.spokes())
    first_[Mesh::face(spoke).index()] = kNone;
  for (const Moved& moved : moved_) {
    TrackedPoint& tracked = points_[moved.sample];
    tracked.squared_distance = moved.squared_distance;
    tracked.next =
        moved.face.is_valid() ? std::exchange(first_[moved.face.index()], moved.sample) : kNone;
  }
}

}  // namespace mesher::simplify
