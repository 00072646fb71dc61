#include "engine/mesh/parts.h"

#include <gtest/gtest.h>

#include "engine/mesh/wedges.h"
#include "tests/support/meshes.h"

namespace mesher {
namespace {

/// A shape with a seam, texture coordinates and a group of this name.
Shape painted(Soup soup, const std::string& group, float u) {
  Shape shape{test::built(std::move(soup)).mesh, {}};
  AttributeLayer corners(texcoord_type(), shape.mesh.halfedge_count());
  for (std::uint32_t h = 0; h < shape.mesh.halfedge_count(); ++h) {
    const glm::vec3& p = shape.mesh.position(shape.mesh.origin(Halfedge(h)));
    // The first face has coordinates of its own.
    corners.values<glm::vec2>()[h] = {u + p.x, h < 3 ? 100.0F : p.y};
  }
  std::vector<AttributeLayer> layers;
  layers.push_back(std::move(corners));
  set_corner_layers(shape.mesh, shape.attributes, std::move(layers));
  shape.attributes.group.assign(shape.mesh.face_count(), 0);
  shape.attributes.groups.push_back({.name = group});
  return shape;
}

void expect_same(const Shape& a, const Shape& b) {
  EXPECT_TRUE(test::is_identical(a.mesh, b.mesh));
  EXPECT_EQ(a.attributes.corner_wedge, b.attributes.corner_wedge);
  EXPECT_EQ(a.attributes.further, b.attributes.further);
  EXPECT_EQ(a.attributes.group, b.attributes.group);
  EXPECT_EQ(a.attributes.groups, b.attributes.groups);
  ASSERT_EQ(a.attributes.layers.size(), b.attributes.layers.size());
  for (std::size_t i = 0; i < a.attributes.layers.size(); ++i) {
    EXPECT_EQ(a.attributes.layers[i].type(), b.attributes.layers[i].type());
    EXPECT_EQ(a.attributes.layers[i].bytes(), b.attributes.layers[i].bytes());
  }
}

void expect_valid(const Shape& shape) {
  test::expect_valid(shape.mesh);
  EXPECT_TRUE(validate(shape.mesh, shape.attributes).empty());
}

TEST(Parts, SplittingGivesBackWhatWasJoined) {
  const Shape cube = painted(test::cube(), "cube", 0.0F);
  const Shape sheet = painted(test::grid(3), "sheet", 7.0F);
  const Shape ties =
      painted(test::bow_tie({test::tetrahedron(), test::tetrahedron()}), "ties", 9.0F);
  const Shape all = joined({cube, sheet, ties});
  expect_valid(all);
  EXPECT_EQ(all.mesh.face_count(),
            cube.mesh.face_count() + sheet.mesh.face_count() + ties.mesh.face_count());
  const std::vector<Shape> parts = split(all.mesh, all.attributes, {0, 1, 2}, 3);
  expect_same(parts[0], cube);
  expect_same(parts[1], sheet);
  expect_same(parts[2], ties);
}

TEST(Parts, SplittingLeavesOutGroupsWithoutPart) {
  const Shape all = joined({painted(test::cube(), "cube", 0.0F), painted(test::grid(2), "a", 1.0F),
                            painted(test::grid(4), "b", 2.0F)});
  const std::vector<Shape> parts = split(all.mesh, all.attributes, {kNone, 0, 0}, 1);
  ASSERT_EQ(parts.size(), 1U);
  expect_valid(parts[0]);
  EXPECT_EQ(parts[0].mesh.face_count(), 2U * (4 + 16));
  EXPECT_EQ(parts[0].attributes.groups, (std::vector<FaceGroup>{{.name = "a"}, {.name = "b"}}));
}

TEST(Parts, ShapesWithoutALayerHaveNoValuesThere) {
  Shape plain = painted(test::cube(), "plain", 0.0F);
  plain.attributes.layers.clear();
  plain.attributes.corner_wedge.clear();
  plain.attributes.further.clear();
  const Shape all = joined({plain, painted(test::grid(2), "sheet", 3.0F)});
  expect_valid(all);
  const AttributeLayer& layer = all.attributes.layers.front();
  EXPECT_TRUE(is_absent(layer, 0));
  EXPECT_FALSE(is_absent(layer, plain.mesh.vertex_count()));
}

TEST(Parts, DifferentTypesBecomeOneThatHoldsBoth) {
  Shape bytes = painted(test::grid(1), "bytes", 0.0F);
  AttributeType fraction = texcoord_type();
  fraction.component = ComponentType::u8;
  fraction.is_normalized = true;
  AttributeLayer layer(fraction, bytes.attributes.layers.front().count());
  for (std::size_t i = 0; i < layer.count(); ++i)
    store(layer, i, {1.0, 0.2, 0.0, 0.0});
  bytes.attributes.layers.front() = layer;
  const Shape all = joined({painted(test::grid(1), "floats", 5.0F), bytes});
  expect_valid(all);
  EXPECT_EQ(all.attributes.layers.front().type(), texcoord_type());
  const AttributeValue value = load(all.attributes.layers.front(), 4);  // the first of `bytes`
  EXPECT_EQ(value[0], 1.0);
  EXPECT_NEAR(value[1], 0.2, 1e-7);
}

TEST(Parts, TurningOverReversesEachFaceAndTwiceNone) {
  const Shape before = painted(test::grid(3), "sheet", 0.0F);
  Shape shape = before;
  shape.mesh.set_sharpness(shape.mesh.edge(Halfedge(1)), 2.0F);
  const float sharp = shape.mesh.sharpness(Halfedge(1));
  const Shape once_before = shape;
  turn_over(shape);
  expect_valid(shape);
  for (std::uint32_t f = 0; f < shape.mesh.face_count(); ++f) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Halfedge now = Mesh::halfedge(Face(f), c);
      const Halfedge old = Mesh::halfedge(Face(f), (3 - c) % 3);
      EXPECT_EQ(shape.mesh.origin(now), before.mesh.origin(old));
      EXPECT_EQ(shape.attributes.corner_wedge[now.index()],
                before.attributes.corner_wedge[old.index()]);
    }
  }
  const Vertex a = once_before.mesh.origin(Halfedge(1));
  const Vertex b = once_before.mesh.target(Halfedge(1));
  EXPECT_EQ(shape.mesh.sharpness(shape.mesh.find_halfedge(b, a)), sharp);
  turn_over(shape);
  EXPECT_TRUE(std::ranges::equal(shape.mesh.origins(), once_before.mesh.origins()));
  EXPECT_TRUE(std::ranges::equal(shape.mesh.twins(), once_before.mesh.twins()));
}

}  // namespace
}  // namespace mesher
