#include "engine/simplify/appraisal.h"

#include <algorithm>
#include <cmath>

#include "engine/simplify/triangle_lanes.h"

namespace mesher::simplify {
namespace {

// Squared length of the area-weighted mean normal below which a vertex counts as pointed. A
// right-angled ridge has 0.5, a cube's corner 1/3. Ridges count as pointed, too: with a threshold
// below 0.5 the largest error is 10 % larger.
constexpr float kPointed = 0.75F;

bool is_pointed(const Surface& surface, Vertex v) {
  const Quadric<float>& q = surface.state(v).quadric;
  return dot(q.g, q.g) < kPointed * q.trace() * q.trace();
}

/// Distance of an edge's ends from the new faces, and of the merged vertex from the old ones. All
/// positions are relative to the merged vertex, so no precision is lost far from the model's
/// origin.
class DistanceMoved {
 public:
  DistanceMoved(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p)
      : surface_(surface), fan_(fan), h_(h), center_{p.x, p.y, p.z} {}

  float find() const {
    const Mesh& mesh = surface_.mesh();
    const Vec3<Float4> from = in_all_lanes(relative_position(mesh.origin(h_)));
    const Vec3<Float4> to = in_all_lanes(relative_position(mesh.target(h_)));
    const Vec3<Float4> center = in_all_lanes({0.0F, 0.0F, 0.0F});
    // The distance of the merged vertex from the ends is an upper bound.
    Float4 of_from = dot(from, from);
    Float4 of_to = dot(to, to);
    Float4 of_center = smaller_of(of_from, of_to);
    for (std::size_t i = 0; i < fan_.size(); i += 4) {
      const Vec3<Float4> first = fan_.four_positions(i) - in_all_lanes(center_);
      const Vec3<Float4> second = fan_.four_positions(i + 1) - in_all_lanes(center_);
      const TriangleLanes after{center, first, second};
      of_from = smaller_of(of_from, squared_distances(from, after));
      of_to = smaller_of(of_to, squared_distances(to, after));
      of_center =
          smaller_of(of_center, squared_distances(center, {apexes(i, from, to), first, second}));
    }
    of_center = smaller_of(of_center, squared_distances(center, faces_at_edge()));
    return std::sqrt(std::max({least_of(of_from), least_of(of_to), least_of(of_center)}));
  }

 private:
  Vec3<float> relative_position(Vertex v) const { return surface_.state(v).position - center_; }

  /// Returns the end of the edge to which each of faces i to i + 3 currently belongs.
  Vec3<Float4> apexes(std::size_t i, const Vec3<Float4>& from, const Vec3<Float4>& to) const {
    const Mesh& mesh = surface_.mesh();
    const Vertex origin = mesh.origin(h_);
    Int4 is_from;
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const Halfedge spoke = fan_.spokes()[std::min(i + lane, fan_.size() - 1)];
      is_from[lane] = mesh.origin(spoke) == origin ? -1 : 0;
    }
    return {select(is_from, from.x, to.x), select(is_from, from.y, to.y),
            select(is_from, from.z, to.z)};
  }

  TriangleLanes faces_at_edge() const {
    const Mesh& mesh = surface_.mesh();
    const Halfedge t = mesh.twin(h_);
    const Vec3<float> left = relative_position(mesh.origin(Mesh::prev(h_)));
    const Vec3<float> right = t.is_valid() ? relative_position(mesh.origin(Mesh::prev(t))) : left;
    const auto two = [](float a, float b) { return Float4{a, b, a, b}; };
    return {in_all_lanes(relative_position(mesh.origin(h_))),
            in_all_lanes(relative_position(mesh.target(h_))),
            {two(left.x, right.x), two(left.y, right.y), two(left.z, right.z)}};
  }

  const Surface& surface_;
  const Fan& fan_;
  Halfedge h_;
  Vec3<float> center_;
};

}  // namespace

Appraisal appraise(const Surface& surface, Halfedge h, const Fan& fan, const Candidate& candidate) {
  const Mesh& mesh = surface.mesh();
  const Vertex from = mesh.origin(h);
  const Vertex to = mesh.target(h);
  const float turned = fan.turned_area() * fan.turned_area();
  const float retreat = std::max(surface.state(from).retreat(), surface.state(to).retreat());
  Appraisal result{candidate.cost + turned, retreat, candidate.cost};
  if (!is_pointed(surface, from) && !is_pointed(surface, to)) return result;
  result.retreat += DistanceMoved(surface, h, fan, candidate.position).find();
  const float worth = result.retreat * result.retreat;
  result.left_behind += worth * worth;
  result.cost = result.left_behind + turned;
  return result;
}

}  // namespace mesher::simplify
