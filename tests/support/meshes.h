#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <random>
#include <vector>

#include "engine/mesh/build/build.h"
#include "engine/mesh/statistics.h"
#include "engine/mesh/validate.h"

namespace mesher::test {

inline Soup soup_of(std::initializer_list<glm::vec3> positions,
                    std::initializer_list<std::uint32_t> corners) {
  Soup soup;
  soup.positions.assign(positions);
  soup.corners.assign(corners);
  return soup;
}

inline Soup tetrahedron() {
  return soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                 {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3});
}

/// The unit cube around the origin: 8 vertices, 12 triangles, outward.
inline Soup cube() {
  return soup_of({{-.5F, -.5F, -.5F},
                  {.5F, -.5F, -.5F},
                  {.5F, .5F, -.5F},
                  {-.5F, .5F, -.5F},
                  {-.5F, -.5F, .5F},
                  {.5F, -.5F, .5F},
                  {.5F, .5F, .5F},
                  {-.5F, .5F, .5F}},
                 {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                  1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7});
}

/// A flat sheet of n x n squares in the plane z = 0.
inline Soup grid(std::uint32_t n) {
  Soup soup;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x)
      soup.positions.push_back({float(x), float(y), 0.0F});
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x;
      for (const std::uint32_t v : {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1}) {
        soup.corners.push_back(v);
      }
    }
  }
  return soup;
}

/// A torus of n x m squares.
inline Soup torus(std::uint32_t n, std::uint32_t m) {
  Soup soup;
  const double tau = 2.0 * std::acos(-1.0);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t k = 0; k < m; ++k) {
      const double u = tau * i / n;
      const double v = tau * k / m;
      const double r = 2.0 + std::cos(v);
      soup.positions.push_back(
          glm::vec3(glm::dvec3(r * std::cos(u), r * std::sin(u), std::sin(v))));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t k = 0; k < m; ++k) {
      const auto at = [&](std::uint32_t x, std::uint32_t y) { return (x % n) * m + y % m; };
      for (const std::uint32_t v :
           {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1)}) {
        soup.corners.push_back(v);
      }
    }
  }
  return soup;
}

/// A band of n squares, closed with a half turn.
inline Soup moebius(std::uint32_t n) {
  Soup soup;
  const double tau = 2.0 * std::acos(-1.0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double u = tau * i / n;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1.0 + side * std::cos(u / 2);
      soup.positions.push_back(
          glm::vec3(glm::dvec3(r * std::cos(u), r * std::sin(u), side * std::sin(u / 2))));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i;
    const std::uint32_t b = 2 * i + 1;
    const std::uint32_t c = i + 1 < n ? 2 * i + 2 : 1;
    const std::uint32_t d = i + 1 < n ? 2 * i + 3 : 0;
    for (const std::uint32_t v : {a, c, d, a, d, b})
      soup.corners.push_back(v);
  }
  return soup;
}

/// Returns the disjoint union; `second` is moved by `offset`.
inline Soup join(Soup first, const Soup& second, const glm::vec3& offset = glm::vec3(0.0F)) {
  const auto base = static_cast<std::uint32_t>(first.positions.size());
  for (const glm::vec3& p : second.positions)
    first.positions.push_back(p + offset);
  for (const std::uint32_t v : second.corners)
    first.corners.push_back(base + v);
  return first;
}

inline Soup scaled(Soup soup, float factor) {
  for (glm::vec3& p : soup.positions)
    p *= factor;
  return soup;
}

/// A torus of 4,800 faces, and cubes of that edge length in its hole.
inline Soup torus_with_specks(std::uint32_t specks, float size) {
  Soup soup = torus(60, 40);
  for (std::uint32_t i = 0; i < specks; ++i) {
    const float x = 0.08F * static_cast<float>(i % 8) - 0.3F;
    const float y = 0.08F * static_cast<float>(i / 8) - 0.3F;
    soup = join(std::move(soup), scaled(cube(), size), {x, y, 0.0F});
  }
  return soup;
}

/// Joins up to four soups at a bow-tie vertex at the origin, which is the first vertex of each.
/// Each part is rotated into a different octant, so that parts do not overlap if each lies in the
/// positive octant of its first vertex.
inline Soup bow_tie(const std::vector<Soup>& parts) {
  constexpr glm::vec3 kTurns[] = {{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}};
  Soup soup = soup_of({{0, 0, 0}}, {});
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto base = static_cast<std::uint32_t>(soup.positions.size()) - 1;
    const auto& positions = parts[i].positions;
    for (std::size_t v = 1; v < positions.size(); ++v)
      soup.positions.push_back(kTurns[i] * (positions[v] - positions[0]));
    for (const std::uint32_t v : parts[i].corners)
      soup.corners.push_back(v == 0 ? 0 : base + v);
  }
  return soup;
}

/// Random triangles over a few points, with every kind of defect.
inline Soup random_soup(std::uint32_t seed) {
  std::mt19937 random(seed);
  Soup soup;
  const std::uint32_t vertices = 4 + seed % 9;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    soup.positions.push_back({float(random() % 100), float(random() % 100), float(random() % 100)});
  }
  for (std::uint32_t i = 0; i < 3 * (2 + seed % 40); ++i) {
    soup.corners.push_back(static_cast<std::uint32_t>(random() % vertices));
  }
  return soup;
}

/// Components, Euler characteristic and boundary loops, which a collapse must not change.
struct Topology {
  std::int64_t euler = 0;
  std::uint32_t components = 0;
  std::uint32_t loops = 0;
  friend bool operator==(const Topology&, const Topology&) = default;
};

inline Topology topology(const Mesh& mesh) {
  const Statistics s = statistics(mesh);
  return {s.euler_characteristic, s.components, s.boundary_loops};
}

/// Fails the test with the first violations if `mesh` breaks an invariant.
inline void expect_valid(const Mesh& mesh) {
  for (const Violation& v : validate(mesh)) {
    ADD_FAILURE() << "invariant " << v.invariant << ": " << v.what;
  }
}

/// Compares bit by bit.
template <class T>
bool is_equal(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

/// Returns whether all arrays of two meshes are equal, bit by bit.
inline bool is_identical(const Mesh& a, const Mesh& b) {
  return is_equal(a.positions(), b.positions()) && is_equal(a.origins(), b.origins()) &&
         is_equal(a.twins(), b.twins()) && is_equal(a.outgoings(), b.outgoings()) &&
         is_equal(a.sharpnesses(), b.sharpnesses()) &&
         is_equal(a.vertex_sharpnesses(), b.vertex_sharpnesses()) &&
         is_equal(a.bow_tie_copies(), b.bow_tie_copies());
}

/// Builds a mesh and validates it.
inline BuildResult built(Soup soup, const BuildOptions& options = {}) {
  BuildResult result = build_mesh(std::move(soup), options);
  expect_valid(result.mesh);
  return result;
}

/// Fails if the repairs differ from `expected`, which lists all that are not zero.
inline void expect_report(const BuildReport& report,
                          std::initializer_list<std::pair<Repair, std::uint64_t>> expected) {
  BuildReport wanted;
  for (const auto& [repair, count] : expected)
    wanted[repair] = count;
  for (std::size_t i = 0; i < kRepairs.size(); ++i) {
    const auto repair = static_cast<Repair>(i);
    EXPECT_EQ(report[repair], wanted[repair]) << describe(repair);
  }
}

}  // namespace mesher::test
