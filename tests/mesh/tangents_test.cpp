#include "engine/mesh/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// A mesh with a normal and texture coordinates per corner.
struct Textured {
  Mesh mesh;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texcoords;

  Array<glm::vec4> tangents() const { return corner_tangents(mesh, normals, texcoords); }
};

/// A flat grid in the plane z = 0 whose texture coordinates are a linear function of x and y.
Textured textured_grid(const glm::vec2& per_x, const glm::vec2& per_y) {
  Textured result{built(grid(4)).mesh, {}, {}};
  for (const Vertex v : result.mesh.origins()) {
    const glm::vec3& p = result.mesh.position(v);
    result.normals.emplace_back(0, 0, 1);
    result.texcoords.push_back(p.x * per_x + p.y * per_y);
  }
  return result;
}

void expect_near(const glm::vec4& a, const glm::vec4& b, const std::string& what = {}) {
  EXPECT_LT(glm::length(a - b), 2e-4F)
      << what << ": " << a.x << ' ' << a.y << ' ' << a.z << ' ' << a.w;
}

TEST(Tangents, FollowU) {
  const float half = 0.5F * std::sqrt(2.0F);
  for (const glm::vec4& t : textured_grid({1, 0}, {0, 1}).tangents())
    expect_near(t, {1, 0, 0, 1}, "straight");
  for (const glm::vec4& t : textured_grid({0, 3}, {-2, 0}).tangents())
    expect_near(t, {0, -1, 0, 1}, "turned");
  for (const glm::vec4& t : textured_grid({1, 1}, {0, 1}).tangents())
    expect_near(t, {half, -half, 0, 1}, "sheared");
  for (const glm::vec4& t : textured_grid({-1, 0}, {0, 1}).tangents())
    expect_near(t, {-1, 0, 0, -1}, "mirrored");
}

TEST(Tangents, AreZeroWithoutTextureOrFaces) {
  EXPECT_TRUE(corner_tangents(Mesh(), {}, {}).empty());
  for (const glm::vec4& t : textured_grid({0, 0}, {0, 0}).tangents())
    EXPECT_EQ(t, glm::vec4(0));
  // All on a line of the texture.
  for (const glm::vec4& t : textured_grid({1, 1}, {2, 2}).tangents())
    EXPECT_EQ(t, glm::vec4(0));
}

TEST(Tangents, DoNotBlendAcrossSeamsOrMirrors) {
  Textured grid = textured_grid({1, 0}, {0, 1});
  for (std::uint32_t h = 0; h < grid.mesh.halfedge_count(); ++h) {
    // The second half of the faces is turned by 90 degrees.
    if (h < grid.mesh.halfedge_count() / 2) continue;
    glm::vec2& t = grid.texcoords[h];
    t = {-t.y - 9.0F, t.x};
  }
  const auto tangents = grid.tangents();
  for (std::uint32_t h = 0; h < grid.mesh.halfedge_count(); ++h) {
    expect_near(tangents[h], h < grid.mesh.halfedge_count() / 2 ? glm::vec4(1, 0, 0, 1)
                                                                : glm::vec4(0, -1, 0, 1));
  }
}

/// A fan of six faces, whose fourth is mirrored and whose fifth has no area in the texture. The
/// expected values are those of the reference implementation (mikktspace 1.1.1 of npm), except at a
/// corner whose only face has no area in the texture: it has (1, 0, 0, -1) there, we have none.
TEST(Tangents, AgreeWithTheReference) {
  const std::vector<glm::vec3> normals{{0, 0, 1},       {0.6F, 0, 0.8F},  {0, 0.6F, 0.8F},
                                       {0, 0.6F, 0.8F}, {-0.6F, 0, 0.8F}, {0, -0.6F, 0.8F},
                                       {0, -0.6F, 0.8F}};
  const std::vector<glm::vec2> texcoords{{0.5F, 0.5F}, {0.9F, 0.45F}, {0.7F, 0.85F}, {0.3F, 0.9F},
                                         {0.1F, 0.5F}, {0.35F, 0.2F}, {0.7F, 0.1F}};
  Textured fan;
  fan.mesh = built(soup_of({{0, 0, 0.5F},
                            {1, 0, 0},
                            {0.5F, 0.8F, 0.1F},
                            {-0.6F, 0.9F, 0},
                            {-1, 0, 0.2F},
                            {-0.4F, -0.7F, 0},
                            {0.6F, -0.9F, -0.1F}},
                           {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 6, 0, 6, 1}))
                 .mesh;
  for (std::uint32_t h = 0; h < fan.mesh.halfedge_count(); ++h) {
    const std::uint32_t v = fan.mesh.origin(Halfedge(h)).index();
    fan.normals.push_back(normals[v]);
    fan.texcoords.push_back(texcoords[v]);
    if (v == 5 && h / 3 <= 4) fan.texcoords.back() = {0.25F, 0.75F};
    if (v == 6 && h / 3 == 4) fan.texcoords.back() = {0.375F, 0.625F};
  }
  const auto tangents = fan.tangents();
  const std::vector<glm::vec4> expected{{0.9983F, 0.0583F, 0, 1},
                                        {0.7956F, 0.1048F, -0.5967F, 1},
                                        {0.9826F, 0.1487F, -0.1115F, 1},
                                        {0.9983F, 0.0583F, 0, 1},
                                        {0.9826F, 0.1487F, -0.1115F, 1},
                                        {0.9952F, -0.0782F, 0.0587F, 1},
                                        {0.9983F, 0.0583F, 0, 1},
                                        {0.9952F, -0.0782F, 0.0587F, 1},
                                        {0.8F, 0, 0.6F, 1},
                                        {1, 0, 0, -1},
                                        {0.8F, 0, 0.6F, -1},
                                        {0.9842F, 0.1417F, 0.1063F, -1},
                                        {1, 0, 0, -1},
                                        {0.9842F, 0.1417F, 0.1063F, -1},
                                        {0, 0, 0, 0},
                                        {0.9983F, 0.0583F, 0, 1},
                                        {0.9845F, -0.1405F, -0.1054F, 1},
                                        {0.7956F, 0.1048F, -0.5967F, 1}};
  ASSERT_EQ(tangents.size(), expected.size());
  for (std::size_t h = 0; h < expected.size(); ++h)
    expect_near(tangents[h], expected[h], std::to_string(h));
}

TEST(Tangents, SameForAnyThreadCount) {
  Textured shape{built(torus(64, 48)).mesh, {}, {}};
  for (const Vertex v : shape.mesh.origins()) {
    const glm::vec3& p = shape.mesh.position(v);
    shape.normals.push_back(glm::normalize(p));
    shape.texcoords.emplace_back(p.x + 0.3F * p.z, p.y);
  }
  const auto expected = shape.tangents();
  const ThreadLimit limit(1);
  EXPECT_EQ(shape.tangents(), expected);
}

}  // namespace
}  // namespace mesher::test
