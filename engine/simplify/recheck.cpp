#include "engine/simplify/recheck.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/analysis/surface_point.h"
#include "engine/analysis/triangle_reach.h"

namespace mesher::simplify {
namespace {

/// Covers rounding in the distance from a face's middle.
constexpr double kReachMargin = 1.0 + 1e-6;

/// If the surroundings of the changed faces have together more than this multiple of the area, most
/// of the input is near a change.
constexpr double kMostOfArea = 4.0;

using analysis::Triangle;

/// A ball around a triangle, large enough to contain all points within `distance`.
struct Surroundings {
  Surroundings(const Triangle& triangle, double distance) {
    for (const glm::dvec3& corner : triangle)
      middle += corner / 3.0;
    for (const glm::dvec3& corner : triangle)
      radius = std::max(radius, glm::distance(middle, corner));
    radius = kReachMargin * (radius + distance);
  }
  double disc() const { return std::numbers::pi * radius * radius; }

  glm::dvec3 middle{0.0};
  double radius = 0.0;
};

double area(const Triangle& t) {
  return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
}

std::vector<Face> faces_where(const Array<bool>& values, bool value) {
  std::vector<Face> faces;
  for (std::uint32_t f = 0; f < values.size(); ++f) {
    if (values[f] == value) faces.emplace_back(f);
  }
  return faces;
}

}  // namespace

std::optional<Recheck> faces_to_recheck(const Trace& now, const Decided& earlier, double distance,
                                        analysis::LazyTree& before) {
  Array<std::uint32_t> index_now;  // by id
  index_now.assign(now.before.face_count(), kNone);
  for (std::uint32_t f = 0; f < now.near_after.size(); ++f)
    index_now[now.near_after[f].index()] = f;
  Array<bool> is_same;  // by index now
  is_same.assign(now.after.face_count(), false);
  std::vector<Surroundings> changes;
  double area_of_all = 0.0;
  double area_of_changes = 0.0;
  for (std::uint32_t f = 0; f < earlier.ids.size(); ++f) {
    const Triangle triangle = analysis::corners_of(earlier.after, Face(f));
    area_of_all += area(triangle);
    const std::uint32_t same = index_now[earlier.ids[f].index()];
    if (same != kNone && analysis::corners_of(now.after, Face(same)) == triangle) {
      is_same[same] = true;
    } else {
      changes.emplace_back(triangle, distance);
      area_of_changes += changes.back().disc();
    }
  }
  if (area_of_changes > kMostOfArea * area_of_all) return std::nullopt;
  Array<bool> is_near;  // by face of the input
  is_near.assign(now.before.face_count(), false);
  for (const Face f : earlier.bounds.beyond)
    is_near[f.index()] = true;
  std::vector<Face> found;
  for (const auto& [middle, radius] : changes) {
    found.clear();
    before.get().within(middle, radius * radius, kNone, found);
    for (const Face f : found)
      is_near[f.index()] = true;
  }
  for (const Face f : earlier.bounds.beyond_of_second) {
    const std::uint32_t same = index_now[earlier.ids[f.index()].index()];
    if (same != kNone) is_same[same] = false;
  }
  return Recheck{faces_where(is_near, true), faces_where(is_same, false)};
}

}  // namespace mesher::simplify
