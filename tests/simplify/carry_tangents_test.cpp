#include "engine/simplify/carry_tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/mesh/corner_attributes.h"
#include "engine/mesh/tangents.h"
#include "engine/simplify/simplify_model.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

AttributeType tangent_type() {
  return {.kind = AttributeKind::tangent, .name = "TANGENT", .components = 4};
}

/// A wavy sheet with normals, and a texture that bends.
struct Wave {
  explicit Wave(bool counts_down = false) {
    Soup soup = grid(24);
    for (glm::vec3& p : soup.positions)
      p.z = 2.0F * std::sin(0.4F * p.x) * std::cos(0.3F * p.y);
    mesh = built(std::move(soup)).mesh;
    for (const Vertex v : mesh.origins()) {
      const glm::vec3 p = mesh.position(v);
      const float u = p.x + 0.02F * p.y * p.y;
      texcoords.emplace_back(0.05F * u, (counts_down ? -0.05F : 0.05F) * p.y);
      const float dx = 0.8F * std::cos(0.4F * p.x) * std::cos(0.3F * p.y);
      const float dy = -0.6F * std::sin(0.4F * p.x) * std::sin(0.3F * p.y);
      normals.push_back(glm::normalize(glm::vec3(-dx, -dy, 1.0F)));
    }
    AttributeType texcoord = texcoord_type();
    texcoord.counts_down = counts_down;
    layers.emplace_back(normal_type(), std::span<const glm::vec3>(normals));
    layers.emplace_back(texcoord, std::span<const glm::vec2>(texcoords));
  }
  /// Returns the tangents that the reference would have computed.
  Array<glm::vec4> tangents() const {
    std::vector<glm::vec2> upward = texcoords;
    if (layers[1].type().counts_down) {
      for (glm::vec2& t : upward)
        t.y = -t.y;
    }
    return corner_tangents(mesh, normals, upward);
  }
  simplify::SimplifiedModel simplified(std::span<const glm::vec4> tangents,
                                       std::uint32_t target) const {
    Attributes attributes;
    std::vector<AttributeLayer> all = layers;
    all.emplace_back(tangent_type(), tangents);
    set_corner_layers(mesh, attributes, std::move(all));
    return simplify::simplify_model(Mesh(mesh), attributes, {.target_faces = target});
  }

  Mesh mesh;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texcoords;
  std::vector<AttributeLayer> layers;
};

/// Returns the values of a layer, one per corner.
template <class T>
std::vector<T> corners_of_layer(const simplify::SimplifiedModel& model, AttributeKind kind) {
  const Mesh& mesh = model.simplified.mesh;
  const AttributeLayer& layer = *model.attributes.find(kind);
  std::vector<T> values;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    values.push_back(
        layer.values<T>()[model.attributes.wedge(mesh.origins(), Halfedge(h)).index()]);
  return values;
}

/// Returns the tangents that follow from the normals and texture coordinates of a result.
Array<glm::vec4> expected_tangents(const simplify::SimplifiedModel& model, bool counts_down) {
  auto texcoords = corners_of_layer<glm::vec2>(model, AttributeKind::texcoord);
  if (counts_down) {
    for (glm::vec2& t : texcoords)
      t.y = -t.y;
  }
  return corner_tangents(model.simplified.mesh,
                         corners_of_layer<glm::vec3>(model, AttributeKind::normal), texcoords);
}

TEST(CarryTangents, FollowFromTheResult) {
  for (const bool counts_down : {false, true}) {
    const Wave wave(counts_down);
    const auto model = wave.simplified(wave.tangents(), 150);
    const auto expected = expected_tangents(model, counts_down);
    const auto found = corners_of_layer<glm::vec4>(model, AttributeKind::tangent);
    ASSERT_EQ(found.size(), 450U);
    for (std::size_t h = 0; h < found.size(); ++h)
      EXPECT_LT(glm::length(found[h] - expected[h]), 1e-5F) << h;
    EXPECT_TRUE(validate(model.simplified.mesh, model.attributes).empty());
  }
}

TEST(CarryTangents, OthersAreCarried) {
  const Wave wave;
  auto drawn = wave.tangents();
  // Turned by 90 degrees, as along brushed metal.
  for (std::uint32_t h = 0; h < drawn.size(); ++h)
    drawn[h] = glm::vec4(glm::cross(wave.normals[h], glm::vec3(drawn[h])), drawn[h].w);
  const auto model = wave.simplified(drawn, 150);
  const auto computed = expected_tangents(model, false);
  const auto found = corners_of_layer<glm::vec4>(model, AttributeKind::tangent);
  for (std::size_t h = 0; h < found.size(); ++h) {
    EXPECT_LT(std::abs(glm::dot(glm::vec3(found[h]), glm::vec3(computed[h]))), 0.5F) << h;
    EXPECT_NEAR(glm::length(glm::vec3(found[h])), 1.0F, 1e-5F) << h;
  }
}

TEST(CarryTangents, CornersWithoutOneStayWithout) {
  const Wave wave;
  auto tangents = wave.tangents();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (std::uint32_t h = 0; h < tangents.size(); ++h) {
    if (wave.mesh.position(wave.mesh.origin(Halfedge(h))).x < 6.0F) tangents[h] = glm::vec4(kNan);
  }
  const auto model = wave.simplified(tangents, 300);
  const auto found = corners_of_layer<glm::vec4>(model, AttributeKind::tangent);
  std::size_t absent = 0;
  for (const glm::vec4& t : found)
    absent += std::isnan(t.x) ? 1 : 0;
  EXPECT_GT(absent, 0U);
  EXPECT_LT(absent, found.size() / 2);
}

TEST(CarryTangents, StayBitForBitIfNoFaceGoes) {
  const Wave wave;
  const auto tangents = wave.tangents();
  const auto model = wave.simplified(tangents, wave.mesh.face_count());
  const auto found = corners_of_layer<glm::vec4>(model, AttributeKind::tangent);
  ASSERT_EQ(found.size(), tangents.size());
  for (std::size_t h = 0; h < found.size(); ++h)
    EXPECT_EQ(found[h], tangents[h]);
}

TEST(CarryTangents, SameForAnyThreadCount) {
  const Wave wave;
  const auto model = wave.simplified(wave.tangents(), 150);
  const ThreadLimit limit(1);
  const auto other = wave.simplified(wave.tangents(), 150);
  EXPECT_EQ(corners_of_layer<glm::vec4>(model, AttributeKind::tangent),
            corners_of_layer<glm::vec4>(other, AttributeKind::tangent));
}

}  // namespace
}  // namespace mesher::test
