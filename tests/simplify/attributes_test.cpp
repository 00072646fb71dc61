#include "engine/simplify/attributes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/meshes.h"

namespace mesher {
namespace {

glm::vec2 texcoord_of(Vertex v) {
  return {0.25F * static_cast<float>(v.index()), 1.0F};
}

/// One value per vertex, and the face index modulo 3 as its group.
Attributes plain_attributes(const Mesh& mesh) {
  Attributes a;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Vertex v = mesh.origin(Halfedge(i));
    a.texcoord.push_back(texcoord_of(v));
    a.normal.push_back({0.0F, static_cast<float>(v.index()), 1.0F});
    a.color.push_back({static_cast<std::uint8_t>(v.index()), 1, 2, 255});
  }
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    a.group.push_back(f % 3);
  a.group_names = {"a", "b", "c"};
  return a;
}

struct Case {
  explicit Case(std::uint32_t target = 60) : mesh(build_mesh(test::grid(8)).mesh) {
    attributes = plain_attributes(mesh);
    result = simplify::simplify(
        Mesh(mesh), {.target_faces = target, .order = simplify::ResultOrder::fill_holes});
  }
  simplify::CarriedAttributes carried() const {
    return simplify::carry_attributes(attributes, mesh.origins(), result);
  }

  Mesh mesh;
  Attributes attributes;
  simplify::Simplified result;
};

TEST(CarryAttributes, VertexValuesStayWithTheirVertices) {
  const Case c;
  const simplify::CarriedAttributes carried = c.carried();
  EXPECT_TRUE(carried.dropped.empty());
  const Attributes& a = carried.attributes;
  ASSERT_EQ(a.texcoord.size(), c.result.mesh.halfedge_count());
  ASSERT_EQ(a.normal.size(), a.texcoord.size());
  ASSERT_EQ(a.color.size(), a.texcoord.size());
  for (std::uint32_t i = 0; i < c.result.mesh.halfedge_count(); ++i) {
    const Vertex source = c.result.vertex_source[c.result.mesh.origin(Halfedge(i)).index()];
    EXPECT_EQ(a.texcoord[i], texcoord_of(source));
    EXPECT_EQ(a.normal[i].y, static_cast<float>(source.index()));
    EXPECT_EQ(a.color[i].x, source.index());
  }
}

TEST(CarryAttributes, GroupsStayWithTheirFaces) {
  const Case c;
  const Attributes a = c.carried().attributes;
  ASSERT_EQ(a.group.size(), c.result.mesh.face_count());
  for (std::uint32_t f = 0; f < c.result.mesh.face_count(); ++f)
    EXPECT_EQ(a.group[f], c.result.face_source[f].index() % 3);
  EXPECT_EQ(a.group_names, c.attributes.group_names);
}

TEST(CarryAttributes, SeamAtARemainingVertexDropsAndReportsTheAttribute) {
  Case c;
  const Vertex survivor = c.result.vertex_source[0];
  c.attributes.texcoord[c.mesh.outgoing(survivor).index()] = {7.0F, 7.0F};
  const simplify::CarriedAttributes carried = c.carried();
  EXPECT_TRUE(carried.attributes.texcoord.empty());
  EXPECT_FALSE(carried.attributes.normal.empty());
  ASSERT_EQ(carried.dropped.size(), 1U);
  EXPECT_EQ(carried.dropped[0].find("texture coordinates (seams at 1 of the "), 0U);
}

TEST(CarryAttributes, SeamAtARemovedVertexIsIgnored) {
  Case c;
  std::vector<bool> survives(c.mesh.vertex_count());
  for (const Vertex v : c.result.vertex_source)
    survives[v.index()] = true;
  std::uint32_t gone = 0;
  while (survives[gone] || c.mesh.valence(Vertex(gone)) < 3)
    ++gone;
  c.attributes.color[c.mesh.outgoing(Vertex(gone)).index()] = {9, 9, 9, 9};
  EXPECT_TRUE(c.carried().dropped.empty());
}

TEST(CarryAttributes, MissingCornerValuesAreEqual) {
  Case c;
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  const Vertex survivor = c.result.vertex_source[0];
  for (std::uint32_t i = 0; i < c.mesh.halfedge_count(); ++i) {
    if (c.mesh.origin(Halfedge(i)) == survivor) c.attributes.texcoord[i] = glm::vec2(kNothing);
  }
  const simplify::CarriedAttributes carried = c.carried();
  EXPECT_TRUE(carried.dropped.empty());
  EXPECT_TRUE(std::isnan(carried.attributes.texcoord[c.result.mesh.outgoing(Vertex(0)).index()].x));
}

TEST(CarryAttributes, EmptyAttributesStayEmpty) {
  Case c;
  c.attributes = {};
  EXPECT_TRUE(c.carried().attributes.is_empty());
  EXPECT_TRUE(c.carried().dropped.empty());
}

TEST(CarryAttributes, NoCollapseKeepsAllAttributes) {
  Case c(1000);
  c.attributes.texcoord[0] = {7.0F, 7.0F};  // also a seam
  const Attributes a = c.carried().attributes;
  EXPECT_TRUE(a.texcoord == c.attributes.texcoord);
  EXPECT_TRUE(a.group == c.attributes.group);
}

TEST(CarryAttributes, AcceptsAnyListOfRemainingElements) {
  const Case c;
  const simplify::CarriedAttributes carried =
      simplify::carry_attributes(c.attributes, c.mesh.origins(),
                                 simplify::Survivors{c.result.mesh, c.result.vertex_source,
                                                     c.result.face_source, c.mesh.vertex_count()});
  EXPECT_TRUE(carried.dropped.empty());
  EXPECT_TRUE(carried.attributes.texcoord == c.carried().attributes.texcoord);
  EXPECT_TRUE(carried.attributes.group == c.carried().attributes.group);
}

}  // namespace
}  // namespace mesher
