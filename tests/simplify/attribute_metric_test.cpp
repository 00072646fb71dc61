#include "engine/simplify/attribute_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/mesh/corner_attributes.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using simplify::attribute_metric;
using simplify::AttributeMetric;

struct Textured {
  explicit Textured(float size = 1.0F, float texture = 1.0F)
      : mesh(built(scaled(grid(6), size)).mesh) {
    for (const Vertex v : mesh.origins()) {
      const glm::vec3 p = mesh.position(v) / size;
      corners.texcoord.push_back({texture * p.x, texture * p.y});
      corners.normal.push_back({0.0F, 0.0F, 1.0F});
      corners.color.push_back({255, 0, 51, 255});
    }
  }
  AttributeMetric metric(const simplify::AttributeWeights& weights = {}) const {
    return attribute_metric(mesh, to_wedges(mesh, CornerAttributes(corners)), weights);
  }

  Mesh mesh;
  CornerAttributes corners;
};

TEST(AttributeMetric, TextureCoordinatesAreLengthsOnTheSurface) {
  // The texture covers the sheet once, so a slide by the whole texture is one by the whole sheet.
  const Textured sheet(10.0F);
  const AttributeMetric metric = sheet.metric({.texcoord = 1.0F, .normal = 0.0F, .color = 0.0F});
  ASSERT_EQ(metric.size, 2U);
  for (std::uint32_t h = 0; h < sheet.mesh.halfedge_count(); ++h) {
    const glm::vec3 p = sheet.mesh.position(sheet.mesh.origin(Halfedge(h)));
    EXPECT_NEAR(metric.at(h)[0], p.x, 1e-4F);
    EXPECT_NEAR(metric.at(h)[1], p.y, 1e-4F);
  }
}

TEST(AttributeMetric, SizeOfTheTextureDoesNotMatter) {
  const AttributeMetric one = Textured(1.0F, 1.0F).metric();
  const AttributeMetric other = Textured(1.0F, 64.0F).metric();
  ASSERT_EQ(one.values.size(), other.values.size());
  for (std::size_t i = 0; i < one.values.size(); ++i)
    EXPECT_NEAR(one.values[i], other.values[i], 1e-5F);
}

TEST(AttributeMetric, GrowsWithTheModel) {
  const AttributeMetric one = Textured(1.0F).metric();
  const AttributeMetric large = Textured(1000.0F).metric();
  for (std::size_t i = 0; i < one.values.size(); ++i)
    EXPECT_NEAR(1000.0F * one.values[i], large.values[i], 1e-2F);
}

TEST(AttributeMetric, LeavesOutWhatDoesNotCount) {
  EXPECT_EQ(Textured().metric().size, 2U + 3U + 4U);
  EXPECT_EQ(Textured().metric({.texcoord = 0.0F, .normal = 0.0F, .color = 0.0F}).size, 0U);
  EXPECT_EQ(Textured().metric({.texcoord = 0.0F, .normal = 1.0F, .color = 0.0F}).size, 3U);
  EXPECT_EQ(Textured(1.0F, 0.0F).metric().size, 7U) << "texture coordinates without area";
  Textured partly;
  partly.corners.texcoord[4] = glm::vec2(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(partly.metric().size, 7U) << "a corner has no texture coordinates";
}

TEST(AttributeMetric, OfFacesFollowsTheirCorners) {
  const AttributeMetric all = Textured().metric();
  const Array<Face> kept{Face(5), Face(2)};
  const AttributeMetric some = simplify::of_faces(all, kept, 4.0F);
  ASSERT_EQ(some.of_corner.size(), 6U);
  for (std::size_t c = 0; c < 6; ++c) {
    const std::size_t before = 3 * (c < 3 ? 5U : 2U) + c % 3;
    for (std::size_t j = 0; j < all.size; ++j)
      EXPECT_EQ(some.at(c)[j], 4.0F * all.at(before)[j]);
  }
}

}  // namespace
}  // namespace mesher::test
