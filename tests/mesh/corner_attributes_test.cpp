#include "engine/mesh/corner_attributes.h"

#include <gtest/gtest.h>

#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

TEST(CornerAttributes, SurviveTheWayThroughWedges) {
  const Mesh mesh = built(cube()).mesh;
  CornerAttributes corners;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    corners.texcoord.push_back({float(h % 5), 1.0F});
    corners.normal.push_back({0.0F, 0.0F, float(h / 6)});
    corners.color.push_back({static_cast<std::uint8_t>(h), 0, 0, 255});
  }
  corners.group.assign(mesh.face_count(), 0);
  corners.groups = test::named_groups({"all"});
  const CornerAttributes expected = corners;
  const Attributes attributes = to_wedges(mesh, std::move(corners));
  EXPECT_TRUE(validate(mesh, attributes).empty());
  const CornerAttributes back = to_corners(mesh, attributes);
  EXPECT_EQ(back.texcoord, expected.texcoord);
  EXPECT_EQ(back.normal, expected.normal);
  EXPECT_EQ(back.color, expected.color);
  EXPECT_EQ(back.group, expected.group);
  EXPECT_EQ(back.groups, expected.groups);
}

TEST(CornerAttributes, TextureCoordinatesThatCountDownAreTurned) {
  const Mesh mesh = built(tetrahedron()).mesh;
  AttributeType type = texcoord_type();
  type.counts_down = true;
  Attributes attributes;
  attributes.layers.emplace_back(type, mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    attributes.layers[0].values<glm::vec2>()[v] = {float(v), 0.25F};
  const CornerAttributes corners = to_corners(mesh, attributes);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    EXPECT_EQ(corners.texcoord[h], glm::vec2(mesh.origin(Halfedge(h)).index(), 0.75F));
}

TEST(CornerAttributes, OtherColorsBecomeBytes) {
  const Mesh mesh = built(tetrahedron()).mesh;
  Attributes attributes;
  attributes.layers.emplace_back(
      AttributeType{AttributeKind::color, "COLOR_0", 3, ComponentType::f32}, mesh.vertex_count());
  for (glm::vec3& color : attributes.layers[0].values<glm::vec3>())
    color = {1.0F, 0.5F, 2.0F};
  EXPECT_EQ(to_corners(mesh, attributes).color[0], glm::u8vec4(255, 128, 255, 255));
}

}  // namespace
}  // namespace mesher::test
