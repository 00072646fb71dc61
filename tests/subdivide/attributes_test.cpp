#include "engine/subdivide/attributes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/subdivide/subdivide.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// Corners of the four children that belong to the vertices a, b, c and to the midpoints ab, bc,
/// ca.
enum Corner : std::size_t { a = 0, ab = 1, ca = 2, b = 4, bc = 5, c = 8 };

/// Two faces with a seam at their common edge.
Attributes two_faces() {
  Attributes attributes;
  attributes.texcoord = {{0, 0}, {1, 0}, {0, 1}, {0.5F, 0.5F}, {1, 1}, {0.25F, 0.75F}};
  attributes.color.assign(6, glm::u8vec4(10, 20, 30, 255));
  attributes.color[1] = {13, 20, 255, 0};
  attributes.normal.assign(6, glm::vec3(0, 0, 1));
  attributes.group = {1, 0};
  attributes.group_names = {"stone", "moss"};
  return attributes;
}

TEST(SubdivideAttributes, TexcoordsAreBisectedWithinEachFace) {
  const Attributes fine = subdivide::subdivide_attributes(two_faces(), 1);
  ASSERT_EQ(fine.texcoord.size(), 24U);
  EXPECT_EQ(fine.texcoord[a], glm::vec2(0, 0));
  EXPECT_EQ(fine.texcoord[b], glm::vec2(1, 0));
  EXPECT_EQ(fine.texcoord[c], glm::vec2(0, 1));
  for (const std::size_t corner : {std::size_t{ab}, std::size_t{3}, std::size_t{9}})
    EXPECT_EQ(fine.texcoord[corner], glm::vec2(0.5F, 0)) << corner;
  for (const std::size_t corner : {std::size_t{bc}, std::size_t{7}, std::size_t{10}})
    EXPECT_EQ(fine.texcoord[corner], glm::vec2(0.5F, 0.5F)) << corner;
  for (const std::size_t corner : {std::size_t{ca}, std::size_t{6}, std::size_t{11}})
    EXPECT_EQ(fine.texcoord[corner], glm::vec2(0, 0.5F)) << corner;
}

TEST(SubdivideAttributes, SeamsRemainSeams) {
  const Mesh mesh =
      built(soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 2, 1, 3, 2})).mesh;
  const Halfedge seam = mesh.find_halfedge(Vertex(1), Vertex(2));
  ASSERT_TRUE(mesh.twin(seam).is_valid());
  Mesh fine = subdivide::subdivide(mesh, {.levels = 3}).mesh;
  const Attributes attributes = subdivide::subdivide_attributes(two_faces(), 3);
  ASSERT_EQ(attributes.texcoord.size(), fine.halfedge_count());
  std::uint32_t at_seam = 0;
  for (std::uint32_t i = 0; i < fine.halfedge_count(); ++i) {
    const Halfedge h(i);
    const Halfedge twin = fine.twin(h);
    if (!twin.is_valid()) continue;
    const bool is_same = attributes.texcoord[i] == attributes.texcoord[Mesh::next(twin).index()];
    const bool is_within_face = i / (3 * 64) == twin.index() / (3 * 64);
    EXPECT_EQ(is_same, is_within_face) << i;
    at_seam += is_within_face ? 0 : 1;
  }
  EXPECT_EQ(at_seam, 2U * 8U);
}

TEST(SubdivideAttributes, MatchPositionsUnderMidpointSubdivision) {
  const Mesh mesh = built(grid(4)).mesh;
  Attributes attributes;
  const auto flat = [](const Mesh& m, Halfedge h) { return glm::vec2(m.position(m.origin(h))); };
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    attributes.texcoord.push_back(flat(mesh, Halfedge(h)));
  const Mesh fine =
      subdivide::subdivide(mesh, {.levels = 2, .scheme = subdivide::Scheme::midpoint}).mesh;
  const Attributes carried = subdivide::subdivide_attributes(attributes, 2);
  for (std::uint32_t h = 0; h < fine.halfedge_count(); ++h)
    EXPECT_EQ(carried.texcoord[h], flat(fine, Halfedge(h))) << h;
}

TEST(SubdivideAttributes, ColorsAreAveragedAndRoundedUp) {
  const Attributes fine = subdivide::subdivide_attributes(two_faces(), 1);
  EXPECT_EQ(fine.color[b], glm::u8vec4(13, 20, 255, 0));
  EXPECT_EQ(fine.color[ab], glm::u8vec4(12, 20, 143, 128));  // from 11.5, 20, 142.5 and 127.5
  EXPECT_EQ(fine.color[ca], glm::u8vec4(10, 20, 30, 255));
}

TEST(SubdivideAttributes, ChildrenInheritTheirGroup) {
  const Attributes fine = subdivide::subdivide_attributes(two_faces(), 2);
  ASSERT_EQ(fine.group.size(), 32U);
  for (std::size_t f = 0; f < fine.group.size(); ++f)
    EXPECT_EQ(fine.group[f], f < 16 ? 1U : 0U) << f;
  EXPECT_EQ(fine.group_names, two_faces().group_names);
}

TEST(SubdivideAttributes, NormalsAreDroppedUnlessNothingIsSubdivided) {
  EXPECT_TRUE(subdivide::subdivide_attributes(two_faces(), 1).normal.empty());
  const Attributes same = subdivide::subdivide_attributes(two_faces(), 0);
  EXPECT_TRUE(same.normal == two_faces().normal);
  EXPECT_TRUE(same.texcoord == two_faces().texcoord);
  EXPECT_TRUE(same.color == two_faces().color);
}

TEST(SubdivideAttributes, MissingCornerValuesGiveMissingMidpoints) {
  Attributes attributes = two_faces();
  attributes.texcoord[1] = glm::vec2(std::numeric_limits<float>::quiet_NaN());
  const Attributes fine = subdivide::subdivide_attributes(attributes, 1);
  for (const std::size_t corner : {b, ab, bc})
    EXPECT_TRUE(std::isnan(fine.texcoord[corner].x)) << corner;
  for (const std::size_t corner : {a, c, ca})
    EXPECT_FALSE(std::isnan(fine.texcoord[corner].x)) << corner;
}

TEST(SubdivideAttributes, EmptyAttributesStayEmpty) {
  EXPECT_TRUE(subdivide::subdivide_attributes({}, 3).is_empty());
}

TEST(SubdividedAttributes, SizeIsThatOfTheResultAndThePreviousLevel) {
  Attributes attributes;
  attributes.texcoord.assign(6, glm::vec2(0.0F));
  attributes.color.assign(6, glm::u8vec4(0));
  attributes.group.assign(2, 0);
  EXPECT_EQ(subdivide::subdivided_attribute_bytes(attributes, 0), 0U);
  constexpr std::size_t kBytes = 6 * 8 + 6 * 4 + 2 * 4;
  EXPECT_EQ(subdivide::subdivided_attribute_bytes(attributes, 1), 5 * kBytes);
  EXPECT_EQ(subdivide::subdivided_attribute_bytes(attributes, 3), 80 * kBytes);
}

}  // namespace
}  // namespace mesher::test
