#include "engine/render/pick.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

Mesh cube() {
  return build_mesh(test::cube()).mesh;
}

TEST(Pick, HitsTheNearSide) {
  const std::optional<Hit> hit = pick(cube(), {{0.1, 0.2, 5.0}, {0.0, 0.0, -1.0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 4.5, 1e-12);
  EXPECT_NEAR(glm::length(hit->point - glm::dvec3(0.1, 0.2, 0.5)), 0.0, 1e-12);
}

TEST(Pick, HitsBackFacesFromInside) {
  const std::optional<Hit> hit = pick(cube(), {{0.1, 0.2, 0.0}, {1.0, 0.0, 0.0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.x, 0.5, 1e-12);
}

TEST(Pick, MissesBesideAndBehind) {
  EXPECT_FALSE(pick(cube(), {{0.6, 0.2, 5.0}, {0.0, 0.0, -1.0}}));
  EXPECT_FALSE(pick(cube(), {{0.1, 0.2, 5.0}, {0.0, 0.0, 1.0}}));
  EXPECT_FALSE(pick(Mesh(), {{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}}));
}

TEST(Pick, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = build_mesh(test::torus(300, 200)).mesh;
  const Ray ray{{0.0, 0.3, 0.2}, glm::normalize(glm::dvec3(1.0, 0.1, 0.05))};
  const std::optional<Hit> many = pick(mesh, ray);
  ASSERT_TRUE(many);
  const ThreadLimit one(1);
  const std::optional<Hit> single = pick(mesh, ray);
  ASSERT_TRUE(single);
  EXPECT_EQ(many->face, single->face);
  EXPECT_EQ(many->distance, single->distance);
}

}  // namespace
}  // namespace mesher::render
