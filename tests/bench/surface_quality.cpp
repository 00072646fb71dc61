#include "tests/bench/surface_quality.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/analysis/distance.h"
#include "engine/mesh/build/build.h"

namespace mesher::bench {
namespace {

/// One side of an edge as seen from a face: `low` < `high` in either direction.
struct EdgeSide {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t face = 0;
  bool runs_down = false;  ///< from `high` to `low`
};

std::vector<EdgeSide> sorted_sides(const Soup& soup) {
  std::vector<EdgeSide> sides;
  sides.reserve(soup.corners.size());
  for (std::uint32_t f = 0; f < soup.face_count(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t from = soup.corners[3 * std::size_t{f} + c];
      const std::uint32_t to = soup.corners[3 * std::size_t{f} + (c + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), f, from > to});
    }
  }
  std::ranges::sort(sides, [](const EdgeSide& a, const EdgeSide& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  return sides;
}

glm::dvec3 area_normal(const Soup& soup, std::uint32_t f) {
  const auto corner = [&](std::size_t c) {
    return glm::dvec3(soup.positions[soup.corners[3 * std::size_t{f} + c]]);
  };
  return glm::cross(corner(1) - corner(0), corner(2) - corner(0));
}

/// Whether two faces of an edge are almost folded onto each other.
bool is_folded(const Soup& soup, const EdgeSide& a, const EdgeSide& b) {
  constexpr double kCosine = -0.8660254037844386;  // of 150 degrees
  const glm::dvec3 n = area_normal(soup, a.face);
  // Faces of opposite orientation traverse their common edge in the same direction.
  const glm::dvec3 m = area_normal(soup, b.face) * (a.runs_down == b.runs_down ? -1.0 : 1.0);
  return glm::dot(n, m) < kCosine * glm::length(n) * glm::length(m);
}

std::int64_t count_used_vertices(const Soup& soup) {
  std::vector<bool> used(soup.positions.size());
  for (const std::uint32_t v : soup.corners)
    used[v] = true;
  return std::ranges::count(used, true);
}

}  // namespace

SurfaceDefects surface_defects(const Soup& soup) {
  const std::vector<EdgeSide> sides = sorted_sides(soup);
  SurfaceDefects defects;
  std::int64_t edges = 0;
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end, ++edges) {
    const EdgeSide& first = sides[begin];
    while (end < sides.size() && sides[end].low == first.low && sides[end].high == first.high)
      ++end;
    if (end - begin > 2) ++defects.nonmanifold_edges;
    if (end - begin == 2 && is_folded(soup, first, sides[begin + 1])) ++defects.folded_edges;
  }
  defects.euler_characteristic = count_used_vertices(soup) - edges + soup.face_count();
  return defects;
}

Reference::Reference(Soup&& triangles)
    : soup(std::move(triangles)),
      mesh(build_mesh(Soup(soup)).mesh),
      defects(surface_defects(soup)) {}

SurfaceQuality surface_quality(const Reference& reference, const Soup& result) {
  const Mesh mesh = build_mesh(Soup(result)).mesh;  // repairs do not move any point of the surface
  const analysis::SurfaceDistance distance = analysis::surface_distance(reference.mesh, mesh);
  const analysis::OneSidedDistance both = distance.two_sided();
  return {distance.percent(both.rms), distance.percent(both.max), surface_defects(result)};
}

}  // namespace mesher::bench
