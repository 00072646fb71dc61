#include "engine/progressive/attribute_morph.h"

#include <gtest/gtest.h>

#include "engine/mesh/wedges.h"
#include "engine/progressive/build.h"
#include "tests/progressive/checks.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// A progressive torus with two charts of texture coordinates.
progressive::Progressive two_charts() {
  const Mesh mesh = built(torus(30, 20)).mesh;
  AttributeLayer uv(texcoord_type(), mesh.halfedge_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const glm::vec3& p = mesh.position(mesh.origin(Halfedge(h)));
    uv.values<glm::vec2>()[h] = {p.x + p.z * p.z, p.y + (h / 3 < 600 ? 0.0F : 9.0F)};
  }
  Attributes attributes;
  std::vector<AttributeLayer> layers;
  layers.push_back(std::move(uv));
  set_corner_layers(mesh, attributes, std::move(layers));
  return progressive::make_progressive(mesh, attributes, {.target_faces = 100});
}

TEST(AttributeMorph, StartsWithTheValuesOfTheCoarseLevel) {
  progressive::Progressive made = two_charts();
  ASSERT_GT(made.mesh.split_count(), 200U);
  progressive::AttributeMorph morph(made.attributes);
  const AttributeLayer& uv = made.attributes.layers()[0];
  for (const std::uint32_t coarse : some_levels(made.mesh, 9)) {
    made.attributes.go_to(coarse);
    std::vector<glm::vec2> before;
    for (std::uint32_t h = 0; h < 3 * made.mesh.face_count(coarse); ++h) {
      before.push_back(uv.values<glm::vec2>()[made.attributes.corner_wedges()[h].index()]);
    }
    for (const std::uint32_t fine :
         {made.mesh.split_count(), (coarse + made.mesh.split_count()) / 2}) {
      made.attributes.go_to(fine);
      morph.follow(made.attributes);
      const GeomorphTime time = GeomorphTime::between(coarse, 0.0F);
      for (std::uint32_t h = 0; h < before.size(); ++h) {
        const Wedge w = made.attributes.corner_wedges()[h];
        const AttributeValue value = morphed_value(uv, morph.view(), 0, w, time);
        ASSERT_NEAR(value[0], before[h].x, 1e-5) << coarse << " " << fine << " " << h;
        ASSERT_NEAR(value[1], before[h].y, 1e-5) << coarse << " " << fine << " " << h;
      }
    }
  }
}

TEST(AttributeMorph, EndsWithTheValuesOfTheLevel) {
  progressive::Progressive made = two_charts();
  progressive::AttributeMorph morph(made.attributes);
  made.attributes.go_to(made.mesh.split_count());
  morph.follow(made.attributes);
  const AttributeLayer& uv = made.attributes.layers()[0];
  for (std::uint32_t w = 0; w < uv.count(); ++w) {
    EXPECT_EQ(morphed_value(uv, morph.view(), 0, Wedge(w), GeomorphTime::between(0, 1.0F)),
              load(uv, w));
  }
}

TEST(AttributeMorph, HeadsDoNotDependOnTheWay) {
  progressive::Progressive made = two_charts();
  progressive::AttributeMorph morph(made.attributes);
  std::vector<std::vector<std::uint32_t>> up;
  const std::vector<std::uint32_t> at = some_levels(made.mesh, 11);
  for (const std::uint32_t level : at) {
    made.attributes.go_to(level);
    morph.follow(made.attributes);
    const auto heads = morph.view().heads.first(made.attributes.wedge_count(level));
    up.emplace_back(heads.begin(), heads.end());
  }
  for (std::size_t i = at.size(); i-- > 0;) {
    made.attributes.go_to(at[i]);
    morph.follow(made.attributes);
    EXPECT_TRUE(
        std::ranges::equal(up[i], morph.view().heads.first(made.attributes.wedge_count(at[i]))));
  }
}

TEST(AttributeMorph, WithoutValuesThatBlendIsEmpty) {
  const Mesh mesh = built(torus(12, 8)).mesh;
  AttributeLayer joints({.kind = AttributeKind::joints,
                         .name = "JOINTS_0",
                         .components = 4,
                         .component = ComponentType::u8},
                        mesh.halfedge_count());
  Attributes attributes;
  std::vector<AttributeLayer> layers;
  layers.push_back(std::move(joints));
  set_corner_layers(mesh, attributes, std::move(layers));
  progressive::Progressive made =
      progressive::make_progressive(mesh, attributes, {.target_faces = 20});
  EXPECT_TRUE(progressive::AttributeMorph(made.attributes).view().is_empty());
  EXPECT_TRUE(progressive::AttributeMorph().view().is_empty());
}

}  // namespace
}  // namespace mesher::test
