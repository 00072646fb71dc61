#include "engine/simplify/fan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "engine/mesh/collapse.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

void expect_agreement(const Mesh& mesh) {
  const simplify::Surface surface(Mesh(mesh), {});
  simplify::Fan fan;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    ASSERT_TRUE(fan.gather(surface, h, 1000));
    const bool is_legal = fan.check_topology(surface) == simplify::Fan::kLegal;
    ASSERT_EQ(is_legal, check_collapse(mesh, h).is_legal())
        << "half-edge " << i << " of " << mesh.face_count() << " faces";
    if (!is_legal) continue;
    // The fan's prediction for the merged vertex must match the mesh after the collapse.
    Mesh collapsed(mesh);
    const Vertex kept = collapse(collapsed, h, mesh.position(mesh.target(h))).kept;
    ASSERT_EQ(fan.is_closed(), !collapsed.is_boundary(kept));
    ASSERT_EQ(fan.size() + (fan.is_closed() ? 0 : 1), collapsed.valence(kept));
  }
}

TEST(Fan, AgreesWithCheckCollapseOnEveryEdgeOfManyMeshes) {
  for (const Soup& soup : {tetrahedron(), cube(), grid(1), grid(2), grid(4), torus(3, 3),
                           torus(5, 4), moebius(5), join(cube(), grid(2), {3, 0, 0})}) {
    expect_agreement(built(Soup(soup)).mesh);
  }
  for (std::uint32_t seed = 0; seed < 600 && !testing::Test::HasFailure(); ++seed)
    expect_agreement(built(random_soup(seed)).mesh);
}

TEST(Fan, StopsAtItsFaceLimit) {
  const simplify::Surface surface(built(grid(4)).mesh, {});
  simplify::Fan fan;
  const Halfedge inner = surface.mesh().find_halfedge(Vertex(12), Vertex(13));
  EXPECT_TRUE(fan.gather(surface, inner, 8));
  EXPECT_EQ(fan.size(), 8U);
  EXPECT_FALSE(fan.gather(surface, inner, 7));
  EXPECT_LE(fan.size(), 7U);
}

TEST(Fan, GrowsBeyondItsInitialCapacity) {
  // A closed fan of 3,000 faces around a hub. One rim edge is collapsed into the hub.
  Soup soup;
  soup.positions.push_back({0, 0, 1});
  constexpr std::uint32_t kSpokes = 3'000;
  for (std::uint32_t i = 0; i < kSpokes; ++i) {
    const float a = 6.2831853F * static_cast<float>(i) / kSpokes;
    soup.positions.push_back({std::cos(a), std::sin(a), 0});
    soup.corners.insert(soup.corners.end(), {0U, i + 1, (i + 1) % kSpokes + 1});
  }
  const simplify::Surface surface(built(std::move(soup)).mesh, {});
  simplify::Fan fan;
  ASSERT_TRUE(fan.gather(surface, surface.mesh().find_halfedge(Vertex(0), Vertex(1)), 4096));
  EXPECT_EQ(fan.size(), kSpokes - 2);
  EXPECT_FALSE(fan.is_closed());
  EXPECT_EQ(fan.check_topology(surface), simplify::Fan::kLegal);
  EXPECT_EQ(fan.check_shape(surface, {1, 0, 0}), simplify::Fan::kLegal);
}

TEST(Fan, RejectsFlippedFaces) {
  const simplify::Surface surface(built(grid(4)).mesh, {});
  simplify::Fan fan;
  ASSERT_TRUE(fan.gather(surface, surface.mesh().find_halfedge(Vertex(12), Vertex(13)), 64));
  EXPECT_EQ(fan.check_shape(surface, {2.5F, 2.0F, 0.0F}), simplify::Fan::kLegal);
  EXPECT_EQ(fan.check_shape(surface, {2.5F, 2.0F, 0.2F}), simplify::Fan::kLegal);
  EXPECT_EQ(fan.turned_area(), 0.0F);
  EXPECT_EQ(fan.check_shape(surface, {5.0F, 2.0F, 0.0F}), simplify::Rejection::fold_over);
  EXPECT_EQ(fan.check_shape(surface, {2.5F, 2.0F, 9.0F}), simplify::Fan::kLegal);
  EXPECT_GT(fan.turned_area(), 4.0F) << "faces that turn by more than 78 degrees count as harmful";
  // On the ring itself, faces have no area.
  EXPECT_EQ(fan.check_shape(surface, {1.0F, 2.0F, 0.0F}), simplify::Rejection::fold_over);
}

TEST(Fan, SliversThatTurnCountLessThanTheirArea) {
  EXPECT_NEAR(simplify::compact_area(std::sqrt(3.0F) / 4.0F, 1.0F), std::sqrt(3.0F) / 4.0F, 1e-6F);
  EXPECT_EQ(simplify::compact_area(0.0F, 0.0F), 0.0F);
  const simplify::Surface surface(built(grid(4)).mesh, {});
  simplify::Fan fan;
  ASSERT_TRUE(fan.gather(surface, surface.mesh().find_halfedge(Vertex(12), Vertex(13)), 64));
  // A spire whose faces can move hardly farther than its width.
  ASSERT_EQ(fan.check_shape(surface, {2.5F, 2.0F, 90.0F}), simplify::Fan::kLegal);
  float area = 0.0F;
  for (std::size_t i = 0; i < fan.size(); ++i)
    area += fan.shape(i).area;
  EXPECT_GT(fan.turned_area(), 0.001F * area);
  EXPECT_LT(fan.turned_area(), 0.1F * area);
}

TEST(Fan, ShapesMatchTheFaces) {
  const simplify::Surface surface(built(torus(9, 7)).mesh, {});
  const Mesh& mesh = surface.mesh();
  simplify::Fan fan;
  const Halfedge h(40);
  ASSERT_TRUE(fan.gather(surface, h, 64));
  const glm::vec3 p = mesh.position(mesh.target(h));
  static_cast<void>(fan.check_shape(surface, p));
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const glm::vec3 a = mesh.position(fan.ring()[i]) - p;
    const glm::vec3 b = mesh.position(fan.ring()[i + 1]) - p;
    EXPECT_NEAR(double(fan.shape(i).area), 0.5 * double(glm::length(glm::cross(a, b))), 1e-5);
    EXPECT_NEAR(double(glm::length(fan.shape(i).normal)), 1.0, 1e-5);
  }
}

}  // namespace
}  // namespace mesher::test
