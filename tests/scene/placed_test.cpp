#include "engine/scene/placed.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/mesh/parts.h"
#include "engine/scene/morph.h"
#include "tests/support/meshes.h"

namespace mesher::scene {
namespace {

glm::dmat4 moved(double x) {
  return glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.0, 0.0));
}

Shape shape_of(Soup soup, std::uint32_t mesh) {
  Shape shape{test::built(std::move(soup)).mesh, {}};
  shape.attributes.group.assign(shape.mesh.face_count(), 0);
  shape.attributes.groups.push_back({.mesh = mesh});
  return shape;
}

/// Mesh 0, a cube, is shown by "first" and, at x = 10, by "second"; mesh 1, a sheet, by "third".
struct TwoMeshes {
  TwoMeshes() {
    scene.nodes.resize(3);
    scene.order = {0, 1, 2};
    scene.nodes[0] = {.name = "first", .mesh = 0};
    scene.nodes[1] = {.name = "second", .to_parent = {.translation = {10.0, 0.0, 0.0}}, .mesh = 0};
    scene.nodes[2] = {.name = "third", .mesh = 1};
    scene.meshes = {{.has_faces = true, .placements = {{.node = 0}, {.node = 1}}},
                    {.has_faces = true, .placements = {{.node = 2}}}};
  }
  Scene scene;
  Shape shape = joined({shape_of(test::cube(), 0), shape_of(test::grid(2), 1)});
  std::uint32_t cube_faces = 12;
  std::uint32_t sheet_faces = 8;
};

TEST(Placed, ShowsEachMeshOnceForEveryPlacement) {
  const TwoMeshes model;
  EXPECT_TRUE(differs_from_model(model.scene));
  const Shape shown = placed(model.shape.mesh, model.shape.attributes, model.scene);
  test::expect_valid(shown.mesh);
  EXPECT_EQ(shown.mesh.face_count(), 2 * model.cube_faces + model.sheet_faces);
  EXPECT_EQ(shown.mesh.position(Vertex(8)),
            shown.mesh.position(Vertex(0)) + glm::vec3(10.0F, 0.0F, 0.0F));
  EXPECT_EQ(shown.attributes.groups[0].object, "first");
  EXPECT_EQ(shown.attributes.groups[1].object, "second");
  EXPECT_EQ(bounds(model.shape.mesh, model.shape.attributes, model.scene).max.x,
            bounding_box(shown.mesh).max.x);
}

TEST(Placed, HiddenNodesAreLeftOut) {
  TwoMeshes model;
  const auto faces = [&](const HiddenNodes& hidden) {
    return placed(model.shape.mesh, model.shape.attributes, model.scene, hidden).mesh.face_count();
  };
  EXPECT_EQ(faces({true, false, false}), model.cube_faces + model.sheet_faces);
  EXPECT_EQ(faces({true, true, false}), model.sheet_faces);
  EXPECT_EQ(faces({true, true, true}), 0U);
}

TEST(Placed, MeshesShownOnceKeepTheirElements) {
  TwoMeshes model;
  model.scene.meshes[0].placements.pop_back();
  EXPECT_FALSE(differs_from_model(model.scene));
  EXPECT_TRUE(differs_from_model(model.scene, {true, false, false}));
  model.scene.nodes[2].to_parent.translation = {0.0, 5.0, 0.0};
  EXPECT_TRUE(differs_from_model(model.scene));
  Copies copies = copies_of(model.shape.mesh, model.shape.attributes, model.scene);
  EXPECT_TRUE(copies.keeps_elements);
  pose(model.scene, {}, copies);
  EXPECT_TRUE(std::ranges::equal(copies.shape.mesh.origins(), model.shape.mesh.origins()));
  EXPECT_EQ(copies.shape.mesh.position(Vertex(0)), model.shape.mesh.position(Vertex(0)));
  EXPECT_EQ(copies.shape.mesh.position(Vertex(8)),
            model.shape.mesh.position(Vertex(8)) + glm::vec3(0.0F, 5.0F, 0.0F));
}

TEST(Placed, MirroredCopiesAreTurnedOver) {
  TwoMeshes model;
  model.scene.nodes[1].to_parent.scale = {-1.0, 1.0, 1.0};
  const Shape shown = placed(model.shape.mesh, model.shape.attributes, model.scene);
  test::expect_valid(shown.mesh);
  const std::vector<Shape> parts = split(shown.mesh, shown.attributes, {kNone, 0, kNone}, 1);
  EXPECT_GT(mesher::statistics(parts[0].mesh).volume, 0.0);
}

TEST(Placed, VerticesFollowTheMeanOfTheirJoints) {
  TwoMeshes model;
  Scene& scene = model.scene;
  scene.meshes = {{.has_faces = true, .placements = {{.node = 0}}}};
  scene.nodes[0].skin = 0;
  scene.nodes[2] = {.to_parent = {.translation = {0.0, 4.0, 0.0}}};
  scene.skins = {{.joints = {1, 2}, .inverse_binds = {glm::dmat4(1.0), glm::dmat4(1.0)}}};
  Shape cube = shape_of(test::cube(), 0);
  AttributeLayer joints({.kind = AttributeKind::joints,
                         .name = "JOINTS_0",
                         .components = 4,
                         .component = ComponentType::u8},
                        8);
  AttributeLayer weights({.kind = AttributeKind::weights, .name = "WEIGHTS_0", .components = 4}, 8);
  for (std::size_t v = 0; v < 8; ++v) {
    store(joints, v, {0.0, 1.0, 0.0, 0.0});
    store(weights, v, v == 0 ? AttributeValue{3.0, 1.0} : AttributeValue{0.0, 1.0});
  }
  cube.attributes.layers = {joints, weights};
  const Shape shown = placed(cube.mesh, cube.attributes, scene);
  const glm::vec3 mean(0.75F * 10.0F, 0.25F * 4.0F, 0.0F);
  EXPECT_EQ(shown.mesh.position(Vertex(0)), cube.mesh.position(Vertex(0)) + mean);
  EXPECT_EQ(shown.mesh.position(Vertex(1)),
            cube.mesh.position(Vertex(1)) + glm::vec3(0.0F, 4.0F, 0.0F));
}

TEST(Placed, MorphTargetsAddToPositionsByTheirWeights) {
  TwoMeshes model;
  model.scene.meshes = {{.has_faces = true, .placements = {{.node = 0}}}};
  model.scene.nodes[0].weights = {0.0, 0.5};
  Shape cube = shape_of(test::cube(), 0);
  for (const char* name : {"target 0 POSITION", "target 1 POSITION"}) {
    AttributeLayer layer({.kind = AttributeKind::delta, .name = name, .components = 3}, 8);
    for (std::size_t v = 0; v < 8; ++v)
      store(layer, v, {0.0, 0.0, v == 3 ? 2.0 : 0.0, 0.0});
    cube.attributes.layers.push_back(layer);
  }
  EXPECT_TRUE(differs_from_model(model.scene));
  const Shape shown = placed(cube.mesh, cube.attributes, model.scene);
  EXPECT_EQ(shown.mesh.position(Vertex(2)), cube.mesh.position(Vertex(2)));
  EXPECT_EQ(shown.mesh.position(Vertex(3)), cube.mesh.position(Vertex(3)) + glm::vec3(0, 0, 1));
}

TEST(Placed, PosesMoveNodesAndWhatIsBelowThem) {
  TwoMeshes model;
  model.scene.nodes[1].parent = 0;
  const NodePoses poses{{0, {.translation = glm::dvec3(0.0, 3.0, 0.0)}}};
  const auto transforms = node_transforms(model.scene, poses);
  EXPECT_EQ(glm::dvec3(transforms[1][3]), glm::dvec3(10.0, 3.0, 0.0));
  EXPECT_EQ(transforms[2], glm::dmat4(1.0));
  EXPECT_EQ(node_transforms(model.scene)[1], moved(10.0));
}

TEST(Placed, ReplacesOneMeshOfAShape) {
  const TwoMeshes model;
  const Shape changed = with_mesh(model.shape, 2, 0, shape_of(test::tetrahedron(), 0));
  test::expect_valid(changed.mesh);
  EXPECT_EQ(changed.mesh.face_count(), 4 + model.sheet_faces);
  EXPECT_EQ(mesh_of(changed, 2, 1).mesh.face_count(), model.sheet_faces);
}

}  // namespace
}  // namespace mesher::scene
