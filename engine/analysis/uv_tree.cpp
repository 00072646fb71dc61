#include "engine/analysis/uv_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/analysis/space_curve.h"
#include "engine/analysis/triangle_tree.h"

namespace mesher::analysis {
namespace {

constexpr double kNoPoint = std::numeric_limits<double>::infinity();

double doubled_area(const std::array<glm::dvec2, 3>& t) {
  const glm::dvec2 ab = t[1] - t[0];
  const glm::dvec2 ac = t[2] - t[0];
  return ab.x * ac.y - ab.y * ac.x;
}

double longest_side(const std::array<glm::dvec2, 3>& t) {
  return std::max({glm::length(t[1] - t[0]), glm::length(t[2] - t[1]), glm::length(t[0] - t[2])});
}

glm::dvec3 flat(const glm::dvec2& uv) {
  return {uv, 0.0};
}

}  // namespace

void UvTree::UvBox::add(const UvTriangle& triangle) {
  for (std::size_t c = 0; c < 3; ++c) {
    uv_min = glm::min(uv_min, triangle.uv[c]);
    uv_max = glm::max(uv_max, triangle.uv[c]);
    min = glm::min(min, triangle.position[c]);
    max = glm::max(max, triangle.position[c]);
  }
}

void UvTree::UvBox::add(const UvBox& box) {
  uv_min = glm::min(uv_min, box.uv_min);
  uv_max = glm::max(uv_max, box.uv_max);
  min = glm::min(min, box.min);
  max = glm::max(max, box.max);
}

UvTree::UvTree(const AttributedSurface& surface) {
  const UvLayers uvs(surface);
  for (const std::uint32_t f : faces_along_curve(surface.mesh)) {
    if (const auto uv = uvs.corners(Face(f)))
      triangles_.push_back({*uv, corners_of(surface.mesh, Face(f))});
  }
  if (triangles_.empty()) return;
  const auto groups = [](std::size_t n) { return (n + kFanout - 1) / kFanout; };
  levels_.emplace_back(groups(triangles_.size()));
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    levels_[0][i / kFanout].add(triangles_[i]);
  while (levels_.back().size() > 1) {
    std::vector<UvBox> above(groups(levels_.back().size()));
    for (std::size_t i = 0; i < levels_.back().size(); ++i)
      above[i / kFanout].add(levels_.back()[i]);
    levels_.push_back(std::move(above));
  }
  const UvBox& all = levels_.back().front();
  const glm::dvec2 largest = glm::max(glm::abs(all.uv_min), glm::abs(all.uv_max));
  tolerance_ = 1e-6 * glm::max(largest.x, largest.y);
}

double UvTree::squared_distance(const glm::dvec2& uv, const glm::dvec3& near) const {
  UvQuery query{.uv = uv, .near = near};
  if (!levels_.empty()) visit(query, levels_.size() - 1, 0);
  return query.least;
}

double UvTree::bound(const UvQuery& query, const UvBox& box) const {
  for (int i = 0; i < 2; ++i) {
    if (query.uv[i] < box.uv_min[i] - tolerance_ || query.uv[i] > box.uv_max[i] + tolerance_)
      return kNoPoint;
  }
  const glm::dvec3 outside =
      glm::max(glm::max(box.min - query.near, query.near - box.max), glm::dvec3(0.0));
  const double squared = glm::dot(outside, outside);
  return squared < query.least ? squared : kNoPoint;
}

double UvTree::squared_distance(const UvQuery& query, const UvTriangle& t) const {
  // Nearly all triangles end here.
  const glm::dvec2 least = glm::min(glm::min(t.uv[0], t.uv[1]), t.uv[2]) - tolerance_;
  const glm::dvec2 most = glm::max(glm::max(t.uv[0], t.uv[1]), t.uv[2]) + tolerance_;
  if (query.uv.x < least.x || query.uv.y < least.y || query.uv.x > most.x || query.uv.y > most.y)
    return kNoPoint;
  const double longest = longest_side(t.uv);
  if (longest <= tolerance_) return analysis::squared_distance(query.near, t.position);
  const auto point = [&](const glm::dvec3& w) {
    return w.x * t.position[0] + w.y * t.position[1] + w.z * t.position[2];
  };
  const auto is_there = [&](const glm::dvec3& w) {
    const glm::dvec2 off = w.x * t.uv[0] + w.y * t.uv[1] + w.z * t.uv[2] - query.uv;
    return glm::length(off) <= tolerance_;
  };
  if (std::abs(doubled_area(t.uv)) > tolerance_ * longest) {
    const glm::dvec3 w =
        nearest_weights(flat(query.uv), {flat(t.uv[0]), flat(t.uv[1]), flat(t.uv[2])});
    if (!is_there(w)) return kNoPoint;
    const glm::dvec3 off = point(w) - query.near;
    return glm::dot(off, off);
  }
  // All texture coordinates are on one line. Points with the same ones form a line across the
  // triangle, between points of its sides.
  std::array<glm::dvec3, 3> ends{};
  std::size_t found = 0;
  for (std::size_t side = 0; side < 3; ++side) {
    const std::size_t next = (side + 1) % 3;
    const glm::dvec3 along =
        nearest_weights(flat(query.uv), {flat(t.uv[side]), flat(t.uv[next]), flat(t.uv[next])});
    glm::dvec3 w(0.0);
    w[static_cast<int>(side)] = along.x;
    w[static_cast<int>(next)] = along.y + along.z;
    if (is_there(w)) ends[found++] = point(w);
  }
  if (found == 0) return kNoPoint;
  for (std::size_t i = found; i < 3; ++i)
    ends[i] = ends[0];
  return analysis::squared_distance(query.near, ends);
}

void UvTree::visit(UvQuery& query, std::size_t level, std::size_t box) const {
  const std::size_t first = kFanout * box;
  if (level == 0) {
    const std::size_t end = std::min(first + kFanout, triangles_.size());
    for (std::size_t i = first; i < end; ++i)
      query.least = std::min(query.least, squared_distance(query, triangles_[i]));
    return;
  }
  const std::vector<UvBox>& below = levels_[level - 1];
  // The nearest first.
  std::array<std::pair<double, std::size_t>, kFanout> near{};
  std::size_t count = 0;
  for (std::size_t i = first; i < std::min(first + kFanout, below.size()); ++i) {
    const double squared = bound(query, below[i]);
    if (squared >= query.least) continue;
    std::size_t at = count++;
    for (; at > 0 && squared < near[at - 1].first; --at)
      near[at] = near[at - 1];
    near[at] = {squared, i};
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (near[i].first < query.least) visit(query, level - 1, near[i].second);
  }
}

}  // namespace mesher::analysis
