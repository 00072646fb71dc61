#include "engine/subdivide/attributes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/mesh/corner_attributes.h"
#include "engine/subdivide/charts.h"
#include "engine/subdivide/subdivide.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// Corners of the four children that belong to the vertices a, b, c and to the midpoints ab, bc,
/// ca.
enum Corner : std::size_t { a = 0, ab = 1, ca = 2, b = 4, bc = 5, c = 8 };

/// Two faces with a seam at their common edge.
CornerAttributes two_faces() {
  CornerAttributes attributes;
  attributes.texcoord = {{0, 0}, {1, 0}, {0, 1}, {0.5F, 0.5F}, {1, 1}, {0.25F, 0.75F}};
  attributes.color.assign(6, glm::u8vec4(10, 20, 30, 255));
  attributes.color[1] = {13, 20, 255, 0};
  attributes.normal.assign(6, glm::vec3(0, 0, 1));
  attributes.group = {1, 0};
  attributes.groups = test::named_groups({"stone", "moss"});
  return attributes;
}

/// Two triangles with a common edge.
Mesh two_triangles() {
  return built(soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 2, 1, 3, 2})).mesh;
}

/// Returns the attributes of a mesh after some levels of Loop subdivision, by corner. Texture
/// coordinates are linear.
CornerAttributes subdivided(const Mesh& mesh, const CornerAttributes& corners,
                            std::uint32_t levels) {
  const subdivide::SubdivideOptions options{.levels = levels,
                                            .uv = subdivide::UvInterpolation::linear};
  const Mesh fine = subdivide::subdivide(mesh, options).mesh;
  const Attributes attributes = subdivide::subdivide_attributes(
      mesh, to_wedges(mesh, CornerAttributes(corners)), fine, options);
  EXPECT_TRUE(validate(fine, attributes).empty());
  return to_corners(fine, attributes);
}

TEST(SubdivideAttributes, TexcoordsAreBisectedWithinEachFace) {
  const CornerAttributes fine = subdivided(two_triangles(), two_faces(), 1);
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
  const Mesh mesh = two_triangles();
  const Halfedge seam = mesh.find_halfedge(Vertex(1), Vertex(2));
  ASSERT_TRUE(mesh.twin(seam).is_valid());
  Mesh fine = subdivide::subdivide(mesh, {.levels = 3}).mesh;
  const CornerAttributes attributes = subdivided(mesh, two_faces(), 3);
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
  CornerAttributes attributes;
  const auto flat = [](const Mesh& m, Halfedge h) { return glm::vec2(m.position(m.origin(h))); };
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    attributes.texcoord.push_back(flat(mesh, Halfedge(h)));
  const subdivide::SubdivideOptions options{.levels = 2, .scheme = subdivide::Scheme::midpoint};
  const Mesh fine = subdivide::subdivide(mesh, options).mesh;
  const CornerAttributes carried = to_corners(
      fine,
      subdivide::subdivide_attributes(mesh, to_wedges(mesh, std::move(attributes)), fine, options));
  for (std::uint32_t h = 0; h < fine.halfedge_count(); ++h)
    EXPECT_EQ(carried.texcoord[h], flat(fine, Halfedge(h))) << h;
}

TEST(SubdivideAttributes, ColorsAreAveragedAndRoundedUp) {
  const CornerAttributes fine = subdivided(two_triangles(), two_faces(), 1);
  EXPECT_EQ(fine.color[b], glm::u8vec4(13, 20, 255, 0));
  EXPECT_EQ(fine.color[ab], glm::u8vec4(12, 20, 143, 128));  // from 11.5, 20, 142.5 and 127.5
  EXPECT_EQ(fine.color[ca], glm::u8vec4(10, 20, 30, 255));
}

TEST(SubdivideAttributes, ChildrenInheritTheirGroup) {
  const CornerAttributes fine = subdivided(two_triangles(), two_faces(), 2);
  ASSERT_EQ(fine.group.size(), 32U);
  for (std::size_t f = 0; f < fine.group.size(); ++f)
    EXPECT_EQ(fine.group[f], f < 16 ? 1U : 0U) << f;
  EXPECT_EQ(fine.groups, two_faces().groups);
}

// A roof of two faces. The old normals are made up: only where they are split matters.
TEST(SubdivideAttributes, NormalsAreThoseOfTheSurfaceAndSplitAsBefore) {
  const Mesh roof =
      built(soup_of({{0, 0, 0}, {0, 1, 0}, {-1, 0, -1}, {1, 0, -1}}, {0, 1, 2, 1, 0, 3})).mesh;
  const float s = std::sqrt(0.5F);
  for (const bool is_split : {true, false}) {
    CornerAttributes attributes;
    attributes.normal.assign(6, glm::vec3(0, 1, 0));
    for (std::size_t corner = 3; is_split && corner < 6; ++corner)
      attributes.normal[corner] = glm::vec3(1, 0, 0);
    const subdivide::SubdivideOptions options{.levels = 1, .scheme = subdivide::Scheme::midpoint};
    const Mesh fine = subdivide::subdivide(roof, options).mesh;
    const CornerAttributes result =
        to_corners(fine, subdivide::subdivide_attributes(
                             roof, to_wedges(roof, std::move(attributes)), fine, options));
    for (std::uint32_t h = 0; h < fine.halfedge_count(); ++h) {
      const glm::vec3 p = fine.position(fine.origin(Halfedge(h)));
      const float side = h < 12 ? -s : s;
      const bool is_on_ridge = p.x == 0.0F && !is_split;
      const glm::vec3 expected = is_on_ridge ? glm::vec3(0, 0, 1) : glm::vec3(side, 0, s);
      EXPECT_NEAR(glm::distance(result.normal[h], expected), 0.0F, 1e-6F) << h << is_split;
    }
  }
}

TEST(SubdivideAttributes, NothingIsComputedWithoutALevel) {
  const CornerAttributes same = subdivided(two_triangles(), two_faces(), 0);
  EXPECT_TRUE(same.normal == two_faces().normal);
  EXPECT_TRUE(same.texcoord == two_faces().texcoord);
  EXPECT_TRUE(same.color == two_faces().color);
}

TEST(SubdivideAttributes, MissingCornerValuesGiveMissingMidpoints) {
  CornerAttributes attributes = two_faces();
  attributes.texcoord[1] = glm::vec2(std::numeric_limits<float>::quiet_NaN());
  const CornerAttributes fine = subdivided(two_triangles(), attributes, 1);
  for (const std::size_t corner : {b, ab, bc})
    EXPECT_TRUE(std::isnan(fine.texcoord[corner].x)) << corner;
  for (const std::size_t corner : {a, c, ca})
    EXPECT_FALSE(std::isnan(fine.texcoord[corner].x)) << corner;
}

TEST(SubdivideAttributes, EmptyAttributesStayEmpty) {
  EXPECT_TRUE(subdivided(two_triangles(), {}, 3).is_empty());
}

/// Attributes by which each vertex v follows joint 10 + v alone.
Attributes one_joint_each(const Mesh& mesh, std::uint8_t components, ComponentType weights) {
  Attributes attributes;
  attributes.layers.emplace_back(
      AttributeType{AttributeKind::joints, "JOINTS_0", components, ComponentType::u8},
      mesh.vertex_count());
  attributes.layers.emplace_back(AttributeType{AttributeKind::weights, "WEIGHTS_0", components,
                                               weights, weights != ComponentType::f32},
                                 mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    store(attributes.layers[0], v, {10.0 + v, 0, 0, 0});
    store(attributes.layers[1], v, {1.0, 0, 0, 0});
  }
  return attributes;
}

TEST(SubdivideAttributes, JointsComeFromBothEnds) {
  const Mesh mesh = two_triangles();
  const Attributes attributes = one_joint_each(mesh, 4, ComponentType::f32);
  const subdivide::SubdivideOptions options{.levels = 2, .scheme = subdivide::Scheme::midpoint};
  const Mesh fine = subdivide::subdivide(mesh, options).mesh;
  const Attributes carried = subdivide::subdivide_attributes(mesh, attributes, fine, options);
  EXPECT_TRUE(validate(fine, carried).empty());
  ASSERT_EQ(carried.layers.size(), 2U);
  ASSERT_EQ(carried.layers[0].count(), fine.vertex_count()) << "both sides of an edge agree";
  for (std::uint32_t v = 0; v < fine.vertex_count(); ++v) {
    const AttributeValue joints = load(carried.layers[0], v);
    const AttributeValue weights = load(carried.layers[1], v);
    glm::vec3 p(0.0F);
    for (std::size_t c = 0; c < 4; ++c) {
      if (weights[c] > 0.0) {
        const Vertex corner(static_cast<std::uint32_t>(joints[c] - 10.0));
        p += static_cast<float>(weights[c]) * mesh.position(corner);
      }
    }
    EXPECT_EQ(p, fine.position(Vertex(v)));
  }
}

TEST(SubdivideAttributes, WeightsKeepTheirSumWhereJointsAreDropped) {
  const Mesh mesh = two_triangles();
  for (const ComponentType type : {ComponentType::f32, ComponentType::u8}) {
    const Attributes attributes = one_joint_each(mesh, 1, type);
    const Mesh fine = subdivide::subdivide(mesh, {.levels = 2}).mesh;
    const Attributes carried =
        subdivide::subdivide_attributes(mesh, attributes, fine, {.levels = 2});
    EXPECT_TRUE(validate(fine, carried).empty());
    for (std::size_t w = 0; w < carried.layers[1].count(); ++w)
      EXPECT_EQ(load(carried.layers[1], w)[0], 1.0);
  }
}

TEST(SubdividedAttributes, SizeIsThatOfTheResultAndThePreviousLevel) {
  const Mesh mesh = two_triangles();
  CornerAttributes corners = two_faces();
  corners.normal = {};
  const Attributes attributes = to_wedges(mesh, std::move(corners));
  const auto bytes = [&](const Attributes& of, std::uint32_t levels) {
    return subdivide::subdivided_attribute_bytes(
        mesh, of, {.levels = levels, .uv = subdivide::UvInterpolation::linear});
  };
  EXPECT_EQ(bytes(attributes, 0), 0U);
  constexpr std::size_t kBytes = 6 * (8 + 4 + 4) + 2 * 4;  // values, wedges and groups
  EXPECT_EQ(bytes(attributes, 1), 5 * kBytes);
  EXPECT_EQ(bytes(attributes, 3), 80 * kBytes);
  EXPECT_EQ(bytes({}, 3), 0U);
  EXPECT_EQ(subdivide::subdivided_attribute_bytes(mesh, attributes, {.levels = 3}),
            80 * kBytes + subdivide::chart_bytes(mesh, 3));
}

}  // namespace
}  // namespace mesher::test
