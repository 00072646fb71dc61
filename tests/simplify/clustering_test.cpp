#include "engine/simplify/clustering.h"

#include <gtest/gtest.h>

#include "engine/mesh/build/build.h"
#include "tests/support/meshes.h"

namespace mesher::simplify {
namespace {

Mesh coarse(const Mesh& mesh, std::uint32_t faces) {
  Mesh result = cluster(mesh, statistics(mesh), faces);
  test::expect_valid(result);
  return result;
}

TEST(Clustering, MeetsTheNumberOfFacesOnSmoothSurfaces) {
  const Mesh torus = build_mesh(test::torus(1000, 500)).mesh;
  for (const std::uint32_t target : {500U, 5'000U, 50'000U}) {
    const std::uint32_t faces = coarse(torus, target).face_count();
    EXPECT_GT(faces, target / 2) << target;
    EXPECT_LT(faces, 2 * target) << target;
  }
}

TEST(Clustering, StaysWithinACellOfTheMesh) {
  const Mesh torus = build_mesh(test::torus(400, 200)).mesh;
  const Box box = bounding_box(torus);
  const Mesh result = coarse(torus, 4'000);
  const Box coarse_box = bounding_box(result);
  const double side = std::sqrt(3.0 * statistics(torus).area / 4'000);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.min[axis], coarse_box.min[axis], side);
    EXPECT_NEAR(box.max[axis], coarse_box.max[axis], side);
  }
  EXPECT_NEAR(statistics(result).area, statistics(torus).area, 0.15 * statistics(torus).area);
}

TEST(Clustering, PartsSmallerThanACellStayVisible) {
  const Mesh dust = build_mesh(test::torus_with_specks(3'000, 1e-4F)).mesh;
  const Mesh result = coarse(dust, 300);
  EXPECT_GT(statistics(result).components, 20U) << "specks far from the torus";
}

TEST(Clustering, AllInOneCellLeavesAFace) {
  EXPECT_EQ(coarse(build_mesh(test::cube()).mesh, 1).face_count(), 1U);
}

TEST(Clustering, TakesMeshesWithoutFacesOrArea) {
  EXPECT_EQ(coarse(Mesh(), 100).face_count(), 0U);
  Mesh flat = build_mesh(test::cube()).mesh;
  Statistics none = statistics(flat);
  none.area = 0.0;
  EXPECT_LE(cluster(flat, none, 100).face_count(), 12U);
}

TEST(Clustering, FarFromTheOriginAndTiny) {
  Soup soup = test::torus(200, 100);
  for (glm::vec3& at : soup.positions)
    at += glm::vec3(1e6F, -1e6F, 1e6F);
  EXPECT_GT(coarse(build_mesh(std::move(soup)).mesh, 2'000).face_count(), 100U);
  EXPECT_GT(
      coarse(build_mesh(test::scaled(test::torus(200, 100), 1e-12F)).mesh, 2'000).face_count(),
      1'000U);
}

}  // namespace
}  // namespace mesher::simplify
