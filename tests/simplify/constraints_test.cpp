// Simplification with boundary rules and creases.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "engine/mesh/circulators.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/simplify.h"
#include "tests/simplify/replay.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using Point = std::array<float, 3>;

std::set<Point> boundary_points(const Mesh& mesh) {
  std::set<Point> points;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const glm::vec3& p = mesh.position(Vertex(v));
    if (mesh.is_boundary(Vertex(v))) points.insert({p.x, p.y, p.z});
  }
  return points;
}

/// A cube of side 1, with n x n squares per side.
Mesh fine_cube(std::uint32_t n) {
  Soup soup;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> ids;
  const auto id = [&](std::array<std::uint32_t, 3> at) {
    const auto [place, is_new] = ids.try_emplace(at, std::uint32_t(soup.positions.size()));
    if (is_new) {
      soup.positions.push_back(glm::vec3(at[0], at[1], at[2]) / static_cast<float>(n));
    }
    return place->second;
  };
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    for (const std::uint32_t side : {0U, n}) {
      for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t k = 0; k < n; ++k) {
          const auto at = [&](std::uint32_t a, std::uint32_t b) {
            std::array<std::uint32_t, 3> p{};
            p[axis] = side;
            p[(axis + 1) % 3] = side == 0 ? b : a;
            p[(axis + 2) % 3] = side == 0 ? a : b;
            return id(p);
          };
          for (const std::uint32_t v : {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k),
                                        at(i + 1, k + 1), at(i, k + 1)}) {
            soup.corners.push_back(v);
          }
        }
      }
    }
  }
  return built(std::move(soup)).mesh;
}

TEST(Boundary, PreserveKeepsLoopsAndCorners) {
  const Mesh sheet = built(grid(16)).mesh;
  for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
    const simplify::Simplified result = simplify::simplify(
        Mesh(sheet), {.target_faces = 2, .cost = static_cast<simplify::CostPolicy>(p)});
    EXPECT_EQ(topology(result.mesh), topology(sheet));
  }
  const simplify::Simplified result = simplify::simplify(Mesh(sheet), {.target_faces = 2});
  const std::set<Point> corners{{0, 0, 0}, {16, 0, 0}, {0, 16, 0}, {16, 16, 0}};
  EXPECT_EQ(result.mesh.face_count(), 2U);
  for (const Point& p : boundary_points(result.mesh)) {
    double nearest = 1e9;
    for (const Point& c : corners) {
      nearest = std::min(nearest, std::hypot(double(p[0] - c[0]), double(p[1] - c[1])));
    }
    EXPECT_LT(nearest, 0.01);
  }
}

TEST(Boundary, LockKeepsEveryBoundaryPoint) {
  const Mesh sheet = built(grid(16)).mesh;
  for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
    const simplify::Simplified result =
        simplify::simplify(Mesh(sheet), {.target_faces = 0,
                                         .cost = static_cast<simplify::CostPolicy>(p),
                                         .boundary = simplify::BoundaryRule::lock});
    EXPECT_EQ(boundary_points(result.mesh), boundary_points(sheet));
    EXPECT_EQ(result.report.reason, simplify::StopReason::no_legal_collapse);
    EXPECT_LE(result.mesh.face_count(), 64U);
  }
}

TEST(Creases, CreaseAngleKeepsEdgesAndCornersOfACube) {
  const Mesh cube = fine_cube(12);
  const simplify::Simplified result =
      simplify::simplify(Mesh(cube), {.target_faces = 12, .crease_angle_deg = 40.0F});
  EXPECT_EQ(result.mesh.face_count(), 12U);
  for (const glm::vec3& p : result.mesh.positions()) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_TRUE(p[axis] == 0.0F || p[axis] == 1.0F) << p.x << ' ' << p.y << ' ' << p.z;
  }
  EXPECT_NEAR(statistics(result.mesh).volume, 1.0, 1e-6);
}

TEST(Creases, TaggedEdgesCollapseOnlyAlongTheCrease) {
  Mesh sheet = built(grid(16)).mesh;
  // A crease along the middle row, from boundary to boundary, and a dart that ends inside.
  const auto at = [](std::uint32_t x, std::uint32_t y) { return Vertex(17 * y + x); };
  for (std::uint32_t x = 0; x < 16; ++x)
    sheet.set_sharpness(sheet.find_edge(at(x, 8), at(x + 1, 8)), 2.0F);
  for (std::uint32_t y = 8; y < 12; ++y)
    sheet.set_sharpness(sheet.find_edge(at(5, y), at(5, y + 1)), kInfinitelySharp);
  for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
    SCOPED_TRACE(key(static_cast<simplify::CostPolicy>(p)));
    simplify::CollapseRecorder recorder;
    const simplify::Simplified result = simplify::simplify(
        Mesh(sheet),
        {.target_faces = 0, .cost = static_cast<simplify::CostPolicy>(p), .observer = &recorder});
    expect_valid(result.mesh);
    // The row is still there: it runs straight from one side to the other, and every edge is a
    // crease.
    double length = 0.0;
    double dart = 0.0;
    for (std::uint32_t i = 0; i < result.mesh.halfedge_count(); ++i) {
      const Halfedge h(i);
      if (result.mesh.edge_class(h) != EdgeClass::crease || result.mesh.twin(h) < h) continue;
      const glm::vec3 a = result.mesh.position(result.mesh.origin(h));
      const glm::vec3 b = result.mesh.position(result.mesh.target(h));
      (result.mesh.sharpness(h) == 2.0F ? length : dart) += double(glm::distance(a, b));
      if (result.mesh.sharpness(h) == 2.0F) {
        EXPECT_NEAR(a.y, 8.0F, 1e-3F);
      }
    }
    EXPECT_NEAR(length, 16.0, 1e-3);
    EXPECT_NEAR(dart, 4.0, 1e-3);
  }
}

TEST(Creases, CornerTagPinsAVertexOfAClosedSurface) {
  Mesh mesh = built(torus(40, 20)).mesh;
  const glm::vec3 p = mesh.position(Vertex(333));
  mesh.set_sharpness(Vertex(333), 2.0F);
  for (const std::uint32_t target : {700U, 100U, 0U}) {
    const simplify::Simplified result = simplify::simplify(Mesh(mesh), {.target_faces = target});
    const auto positions = result.mesh.positions();
    EXPECT_EQ(std::count(positions.begin(), positions.end(), p), 1);
  }
}

TEST(Constraints, ReportNamesTheConstraintThatStopsTheRun) {
  const simplify::Simplified cube =
      simplify::simplify(fine_cube(1), {.target_faces = 4, .crease_angle_deg = 30.0F});
  EXPECT_EQ(cube.report.reason, simplify::StopReason::no_legal_collapse);
  EXPECT_EQ(cube.report[simplify::Rejection::crease], 18U) << "every edge joins two corners";
  const simplify::Simplified sheet = simplify::simplify(
      built(grid(16)).mesh, {.target_faces = 0, .boundary = simplify::BoundaryRule::lock});
  EXPECT_GE(sheet.report[simplify::Rejection::boundary], 64U);
}

TEST(Creases, CornerTagPinsItsVertex) {
  Mesh sheet = built(grid(8)).mesh;
  sheet.set_sharpness(Vertex(40), 1.0F);
  const glm::vec3 p = sheet.position(Vertex(40));
  const simplify::Simplified result = simplify::simplify(Mesh(sheet), {.target_faces = 0});
  const auto positions = result.mesh.positions();
  EXPECT_EQ(std::count(positions.begin(), positions.end(), p), 1);
}

}  // namespace
}  // namespace mesher::test
