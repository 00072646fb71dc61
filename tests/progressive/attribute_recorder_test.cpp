#include "engine/progressive/attribute_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "engine/core/parallel.h"
#include "engine/mesh/wedges.h"
#include "engine/progressive/build.h"
#include "engine/simplify/carry_attributes.h"
#include "tests/progressive/charts.h"
#include "tests/progressive/checks.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using progressive::Progressive;
using progressive::ProgressiveAttributes;

/// Fails unless the full detail has the values of the input at every corner, bit for bit.
void expect_has_input(Progressive& made, const simplify::Attributed& input) {
  made.attributes.go_to(made.mesh.split_count());
  const ProgressiveAttributes& all = made.attributes;
  ASSERT_EQ(all.layers().size(), input.attributes.layers.size());
  for (std::uint32_t f = 0; f < input.mesh.face_count(); ++f) {
    Halfedge source = made.face_source[f];
    for (std::uint32_t c = 0; c < 3; ++c, source = Mesh::next(source)) {
      const Wedge w = all.corner_wedges()[3 * f + c];
      ASSERT_LT(w.index(), all.wedge_count(all.level()));
      const Wedge from = input.attributes.wedge(input.mesh.origins(), source);
      for (std::size_t l = 0; l < all.layers().size(); ++l) {
        ASSERT_TRUE(std::ranges::equal(all.layers()[l].value(w.index()),
                                       input.attributes.layers[l].value(from.index())));
      }
    }
  }
}

/// What a level shows.
struct Shown {
  std::vector<Wedge> wedges;
  std::vector<std::vector<std::byte>> values;
  friend bool operator==(const Shown&, const Shown&) = default;
};

Shown shown(const Progressive& made) {
  const ProgressiveAttributes& all = made.attributes;
  Shown result;
  const std::size_t corners = 3 * std::size_t{made.mesh.face_count(all.level())};
  result.wedges.assign(all.corner_wedges().begin(), all.corner_wedges().begin() + corners);
  for (const AttributeLayer& layer : all.layers()) {
    const auto& bytes = layer.bytes();
    const std::size_t size = all.wedge_count(all.level()) * layer.type().value_bytes();
    result.values.emplace_back(bytes.begin(), bytes.begin() + size);
  }
  return result;
}

void examine_attributes(const Mesh& mesh, const Attributes& attributes, std::uint32_t faces = 1) {
  Progressive made = progressive::make_progressive(mesh, attributes, {.target_faces = faces});
  ASSERT_EQ(made.mesh.level(), 0U);
  ASSERT_EQ(made.attributes.level(), 0U);
  ASSERT_EQ(made.attributes.split_count(), made.mesh.split_count());
  const std::vector<std::uint32_t> at = some_levels(made.mesh, 30);
  std::vector<Shown> up;
  for (const std::uint32_t level : at) {
    made.attributes.go_to(level);
    made.mesh.go_to(level);
    expect_valid_level(made.mesh, made.attributes);
    if (testing::Test::HasFatalFailure()) return;
    up.push_back(shown(made));
  }
  expect_has_input(made, {mesh, attributes});
  for (std::size_t i = at.size(); i-- > 0;) {
    made.attributes.go_to(at[i]);
    ASSERT_EQ(shown(made), up[i]) << "W3, level " << at[i];
  }
}

TEST(ProgressiveAttributes, LevelsAreExactWithAndWithoutSeams) {
  const Mesh mesh = built(torus(24, 16)).mesh;
  examine_attributes(mesh, charted(mesh, [](std::uint32_t) { return 0; }));
  examine_attributes(mesh, charted(mesh, [](std::uint32_t f) { return f / 256; }));
  examine_attributes(mesh, charted(mesh, [](std::uint32_t f) { return f % 5; }));
  const Mesh flat = built(grid(16)).mesh;
  examine_attributes(flat, charted(flat, [](std::uint32_t f) { return f < 256 ? 0 : 1; }));
}

TEST(ProgressiveAttributes, RandomSoupsWithRandomSeams) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = build_mesh(random_soup(seed)).mesh;
    std::mt19937 random(seed);
    std::vector<int> charts(mesh.face_count());
    for (int& chart : charts)
      chart = static_cast<int>(random() % (1 + seed % 4));
    examine_attributes(mesh, charted(mesh, [&](std::uint32_t f) { return charts[f]; }));
    ASSERT_FALSE(HasFailure());
  }
}

TEST(ProgressiveAttributes, SoftNormalsAreAveraged) {
  // Normals per face that differ by a few degrees are no lines, so a merged vertex has one wedge.
  const Mesh mesh = built(torus(60, 40)).mesh;
  AttributeLayer normal(normal_type(), mesh.halfedge_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const glm::vec3 n = glm::normalize(glm::vec3(0.02F * static_cast<float>(f % 3), 0, 1));
    for (std::uint32_t c = 0; c < 3; ++c)
      normal.values<glm::vec3>()[3 * f + c] = n;
  }
  Attributes attributes;
  std::vector<AttributeLayer> layers;
  layers.push_back(std::move(normal));
  set_corner_layers(mesh, attributes, std::move(layers));
  ASSERT_TRUE(attributes.has_seams());
  examine_attributes(mesh, attributes, 200);
}

TEST(ProgressiveAttributes, LinearValuesOverAPlaneStayLinear) {
  const Mesh mesh = built(grid(24)).mesh;
  Progressive made = progressive::make_progressive(
      mesh, charted(mesh, [](std::uint32_t f) { return f < 576 ? 0 : 1; }), {.target_faces = 1});
  ASSERT_LT(made.mesh.base_face_count(), 40U);
  for (const std::uint32_t level : some_levels(made.mesh, 12)) {
    made.mesh.go_to(level);
    made.attributes.go_to(level);
    const Mesh& coarse = made.mesh.mesh();
    for (std::uint32_t h = 0; h < coarse.halfedge_count(); ++h) {
      const glm::vec3& p = coarse.position(coarse.origin(Halfedge(h)));
      const Wedge w = made.attributes.corner_wedges()[h];
      const glm::vec2 uv = made.attributes.layers()[0].values<glm::vec2>()[w.index()];
      const float chart = Mesh::face(made.face_source[h / 3]).index() < 576 ? 0.0F : 3.0F;
      ASSERT_NEAR(uv.x, 0.125F * p.x + chart, 1e-4F);
      ASSERT_NEAR(uv.y, 0.25F * p.y + 0.0625F * p.x, 1e-4F);
    }
  }
}

TEST(ProgressiveAttributes, GroupsFollowTheirFaces) {
  const Mesh mesh = built(grid(8)).mesh;
  Attributes attributes;
  attributes.groups = named_groups({"left", "right"});
  attributes.group.resize(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    attributes.group[f] = f % 3 == 0 ? 1 : 0;
  Progressive made = progressive::make_progressive(mesh, attributes, {.target_faces = 1});
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    EXPECT_EQ(made.attributes.group()[f],
              attributes.group[Mesh::face(made.face_source[f]).index()]);
  }
  const Attributes base = made.attributes.at_level(made.mesh.mesh());
  EXPECT_EQ(base.groups, attributes.groups);
  EXPECT_EQ(base.group.size(), made.mesh.base_face_count());
}

TEST(ProgressiveAttributes, AreTheSameForAnyNumberOfThreads) {
  const Mesh mesh = built(torus(80, 50)).mesh;
  const Attributes attributes = charted(mesh, [](std::uint32_t f) { return f / 999; });
  const auto base = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return shown(progressive::make_progressive(mesh, attributes, {.target_faces = 300}));
  };
  EXPECT_EQ(base(1), base(2));
}

}  // namespace
}  // namespace mesher::test
