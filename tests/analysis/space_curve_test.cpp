#include "engine/analysis/space_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// A small triangle in each cell of a cube of n x n x n cells.
Soup triangle_in_each_cell(std::uint32_t n) {
  Soup soup;
  for (std::uint32_t i = 0; i < n * n * n; ++i) {
    const glm::vec3 at(float(i % n), float(i / n % n), float(i / n / n));
    const auto base = static_cast<std::uint32_t>(soup.positions.size());
    for (const glm::vec3 corner : {glm::vec3(0.4F), {0.6F, 0.5F, 0.5F}, {0.5F, 0.6F, 0.5F}})
      soup.positions.push_back(at + corner);
    soup.corners.insert(soup.corners.end(), {base, base + 1, base + 2});
  }
  return soup;
}

TEST(SpaceCurve, MovesBetweenNeighboringCells) {
  const Mesh mesh = built(triangle_in_each_cell(8)).mesh;
  const Array<std::uint32_t> order = analysis::faces_along_curve(mesh);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const auto at = [&](std::size_t k) {
      return mesh.position(mesh.origin(Mesh::halfedge(Face(order[k]), 0)));
    };
    EXPECT_NEAR(glm::distance(at(i - 1), at(i)), 1.0F, 1e-5F) << i;
  }
}

TEST(SpaceCurve, VisitsEveryFaceOnce) {
  const Mesh mesh = built(torus(70, 40)).mesh;
  Array<std::uint32_t> order = analysis::faces_along_curve(mesh);
  std::sort(order.begin(), order.end());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    EXPECT_EQ(order[f], f);
}

TEST(SpaceCurve, AcceptsExtremeCoordinates) {
  const Mesh mesh = built(soup_of({{-3e38F, 0, 0}, {3e38F, 0, 0}, {0, 3e38F, 0}, {0, 0, 1e-30F}},
                                  {0, 1, 2, 0, 2, 3}))
                        .mesh;
  EXPECT_EQ(analysis::faces_along_curve(mesh).size(), 2U);
  const Mesh point = built(soup_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {0, 1, 2})).mesh;
  EXPECT_EQ(analysis::faces_along_curve(point).size(), std::size_t{point.face_count()});
}

}  // namespace
}  // namespace mesher::test
