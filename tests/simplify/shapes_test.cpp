#include "engine/simplify/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/simplify/simplify.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using simplify::ReducedShape;
using simplify::SceneShape;

const Attributes kNoAttributes;

std::uint64_t shown(const std::vector<SceneShape>& scene, const std::vector<ReducedShape>& result) {
  std::uint64_t faces = 0;
  for (std::size_t i = 0; i < scene.size(); ++i)
    faces += scene[i].weight * result[i].shape.mesh.face_count();
  return faces;
}

TEST(ShapesReducer, OneShapeIsSimplifiedAsAlone) {
  const Mesh mesh = built(torus(60, 40)).mesh;
  simplify::ShapesReducer reducer({{mesh, kNoAttributes, 3}}, {});
  const std::vector<ReducedShape> result = reducer.reduce(3'000);
  EXPECT_TRUE(is_identical(result[0].shape.mesh,
                           simplify::simplify(Mesh(mesh), {.target_faces = 1'000}).mesh));
}

TEST(ShapesReducer, BudgetFollowsErrorInTheScene) {
  const Mesh mesh = built(torus(60, 40)).mesh;
  const Mesh small = built(scaled(torus(60, 40), 0.5F)).mesh;
  // The second one is twice as large in the scene, with an own mesh of half the size.
  const std::vector<SceneShape> scene{{mesh, kNoAttributes, 1, 1.0},
                                      {small, kNoAttributes, 2, 4.0}};
  simplify::ShapesReducer reducer(scene, {});
  for (const std::uint64_t target : {9'000U, 3'000U, 600U}) {
    const std::vector<ReducedShape> result = reducer.reduce(target);
    EXPECT_LE(shown(scene, result), target);
    EXPECT_GE(shown(scene, result) + 6, target);
    EXPECT_GT(result[1].shape.mesh.face_count(), result[0].shape.mesh.face_count());
  }
}

TEST(ShapesReducer, PerShapeKeepsTheSameShareOfEach) {
  const Mesh torus_mesh = built(torus(60, 40)).mesh;
  const Mesh flat = built(grid(30)).mesh;
  const std::vector<SceneShape> scene{{torus_mesh, kNoAttributes}, {flat, kNoAttributes}};
  simplify::ShapesReducer reducer(scene, {.per_shape = true});
  const std::vector<ReducedShape> result = reducer.reduce(660);
  EXPECT_EQ(result[0].shape.mesh.face_count(), 480U);
  EXPECT_EQ(result[1].shape.mesh.face_count(), 180U);
}

TEST(ShapesReducer, ShapesThatAreNotShownKeepTheShareOfTheScene) {
  const Mesh mesh = built(torus(60, 40)).mesh;
  const std::vector<SceneShape> scene{{mesh, kNoAttributes, 1}, {mesh, kNoAttributes, 0}};
  simplify::ShapesReducer reducer(scene, {});
  const std::vector<ReducedShape> result = reducer.reduce(1'200);
  EXPECT_EQ(result[0].shape.mesh.face_count(), 1'200U);
  EXPECT_EQ(result[1].shape.mesh.face_count(), 1'200U);
}

TEST(ShapesReducer, MinimalShapesLeaveTheRestToOthers) {
  const Mesh minimal = built(tetrahedron()).mesh;
  const Mesh mesh = built(torus(60, 40)).mesh;
  const std::vector<SceneShape> scene{{minimal, kNoAttributes, 25}, {mesh, kNoAttributes}};
  simplify::ShapesReducer reducer(scene, {});
  const std::vector<ReducedShape> result = reducer.reduce(300);
  EXPECT_EQ(result[0].shape.mesh.face_count(), 4U);
  EXPECT_EQ(result[1].shape.mesh.face_count(), 200U);
  const std::vector<ReducedShape> fewest = reducer.reduce(1);
  EXPECT_EQ(fewest[1].shape.mesh.face_count(),
            simplify::simplify(Mesh(mesh), {}).mesh.face_count());
}

TEST(ShapesReducer, WithoutATargetOnlyErrorsCount) {
  const Mesh mesh = built(torus(60, 40)).mesh;
  const std::vector<SceneShape> scene{{mesh, kNoAttributes}, {mesh, kNoAttributes, 1, 10.0}};
  simplify::ShapesReducer reducer(scene, {.rules = {.max_error = 0.05}});
  const std::vector<ReducedShape> result = reducer.reduce(0);
  EXPECT_LE(result[0].report.measured_error, 0.05);
  EXPECT_LE(result[1].report.measured_error, 0.005);
  EXPECT_LT(2 * result[0].shape.mesh.face_count(), result[1].shape.mesh.face_count());
}

TEST(ShapesReducer, EmptyScene) {
  simplify::ShapesReducer none({}, {});
  EXPECT_TRUE(none.reduce(10).empty());
  const Mesh empty;
  simplify::ShapesReducer reducer({{empty, kNoAttributes}, {empty, kNoAttributes, 0}}, {});
  EXPECT_EQ(reducer.reduce(10)[0].shape.mesh.face_count(), 0U);
}

}  // namespace
}  // namespace mesher::test
