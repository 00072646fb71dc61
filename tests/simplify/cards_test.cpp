#include "engine/simplify/cards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "engine/core/parallel.h"
#include "engine/mesh/corner_attributes.h"
#include "engine/simplify/shapes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using simplify::LooseCards;
using simplify::ReducedShape;

/// A unit square of two triangles, and its back.
Soup leaf(bool has_back) {
  Soup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3});
  if (has_back) {
    for (const std::uint32_t v : {0U, 2U, 1U, 0U, 3U, 2U})
      soup.corners.push_back(v);
  }
  return soup;
}

/// Leaves of size 0.2 to 0.4 in a cube of side 4, and a trunk.
Soup tree(std::uint32_t leaves, bool has_back = false) {
  std::mt19937 random(7);
  const auto number = [&](float least, float most) {
    return least + (most - least) * float(random() % 1000) / 1000.0F;
  };
  Soup soup = torus(60, 40);
  for (std::uint32_t i = 0; i < leaves; ++i) {
    const glm::vec3 at(number(6, 10), number(-2, 2), number(-2, 2));
    soup = join(std::move(soup), scaled(leaf(has_back), number(0.2F, 0.4F)), at);
  }
  return soup;
}

double area_of_leaves(const Mesh& mesh) {
  double area = 0.0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const auto p = [&](std::uint32_t c) {
      return glm::dvec3(mesh.position(mesh.origin(Mesh::halfedge(Face(f), c))));
    };
    if (p(0).x > 4.5) area += 0.5 * glm::length(glm::cross(p(1) - p(0), p(2) - p(0)));
  }
  return area;
}

ReducedShape reduced(const Mesh& mesh, std::uint64_t faces, const Attributes& attributes = {},
                     simplify::ShapesOptions options = {}) {
  simplify::ShapesReducer reducer({{mesh, attributes}}, options);
  return std::move(reducer.reduce(faces).front());
}

TEST(LooseCards, ManySmallOpenPartsAreFound) {
  const Mesh mesh = built(tree(40)).mesh;
  const LooseCards cards = simplify::find_cards(mesh, {});
  ASSERT_EQ(cards.sets.size(), 1U);
  EXPECT_EQ(cards.sets[0].cards.size(), 40U);
  EXPECT_EQ(cards.sets[0].faces, 80U);
  EXPECT_EQ(cards.rest_faces, 4'800U);
  std::vector<std::uint32_t> all(40);
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_TRUE(std::ranges::is_permutation(cards.sets[0].order, all));
}

TEST(LooseCards, BothSidesOfALeafAreOneCard) {
  const LooseCards cards = simplify::find_cards(built(tree(40, true)).mesh, {});
  ASSERT_EQ(cards.sets.size(), 1U);
  EXPECT_EQ(cards.sets[0].cards.size(), 40U);
  EXPECT_EQ(cards.sets[0].cards[0].faces, 4U);
}

TEST(LooseCards, OtherPartsAreNot) {
  EXPECT_TRUE(simplify::find_cards(built(tree(15)).mesh, {}).sets.empty()) << "too few";
  EXPECT_TRUE(simplify::find_cards(Mesh(), {}).sets.empty());
  Soup closed = torus(20, 12);
  Soup touching = grid(20);
  Soup pointlike = torus(20, 12);
  for (int i = 0; i < 40; ++i) {
    closed = join(std::move(closed), tetrahedron(), {10.0F + 2.0F * float(i), 0.0F, 0.0F});
    // With vertices of its own at the corners of a larger part.
    touching =
        join(std::move(touching), leaf(false), {2.0F * float(i % 5), 2.0F * float(i / 5), 0.0F});
    pointlike = join(std::move(pointlike), scaled(leaf(false), 1e-30F), {float(i), 9.0F, 9.0F});
  }
  for (glm::vec3& p : touching.positions)
    p.z = 0.0F;
  EXPECT_TRUE(simplify::find_cards(built(std::move(closed)).mesh, {}).sets.empty());
  BuildOptions as_is;
  EXPECT_TRUE(simplify::find_cards(built(std::move(touching), as_is).mesh, {}).sets.empty());
  EXPECT_TRUE(simplify::find_cards(built(std::move(pointlike)).mesh, {}).sets.empty());
  // A much larger part of the same material is no card.
  Soup large = join(tree(40), scaled(leaf(false), 50.0F), {0.0F, 0.0F, -9.0F});
  EXPECT_EQ(simplify::find_cards(built(std::move(large)).mesh, {}).sets[0].cards.size(), 40U);
}

TEST(LooseCards, AreaStaysWhenSomeAreRemoved) {
  const Mesh mesh = built(tree(200)).mesh;
  const ReducedShape result = reduced(mesh, 300);
  expect_valid(result.shape.mesh);
  EXPECT_EQ(result.cards.cards, 200U);
  EXPECT_GT(result.cards.removed, 50U);
  EXPECT_LT(result.cards.removed, 195U);
  EXPECT_GT(result.cards.enlarged, 1.0);
  EXPECT_LE(result.report.faces_reached, 300U);
  EXPECT_GE(result.report.faces_reached, 297U);
  EXPECT_EQ(result.report.reason, simplify::StopReason::target_reached);
  EXPECT_NEAR(area_of_leaves(result.shape.mesh) / area_of_leaves(mesh), 1.0, 1e-4);
  const std::uint32_t leaves = 2 * (result.cards.cards - result.cards.removed);
  EXPECT_GT(result.report.faces_reached - leaves, 60U) << "the trunk is not eaten instead";
  EXPECT_GT(result.report.estimated_error, 0.0);
}

TEST(LooseCards, StayWhileOtherFacesCostLess) {
  const Mesh mesh = built(tree(40)).mesh;
  const ReducedShape result = reduced(mesh, 2'000);
  EXPECT_EQ(result.cards.removed, 0U);
  EXPECT_EQ(result.report.faces_reached, 2'000U);
}

TEST(LooseCards, CanBeKept) {
  const Mesh mesh = built(tree(200)).mesh;
  const ReducedShape result = reduced(mesh, 300, {}, {.keeps_cards = true});
  EXPECT_EQ(result.cards.cards, 0U);
  EXPECT_EQ(statistics(result.shape.mesh).components, 201U);
  const ReducedShape bounded = reduced(mesh, 300, {}, {.rules = {.max_error = 0.1}});
  EXPECT_EQ(bounded.cards.cards, 0U) << "a removed card would break the bound";
}

TEST(LooseCards, CoarseLevelsShowPartOfFinerOnes) {
  const Mesh mesh = built(tree(200)).mesh;
  const LooseCards cards = simplify::find_cards(mesh, {});
  const simplify::CardThinning thinning(mesh, cards, 0);
  EXPECT_EQ(thinning.cards_for(400), 200U);
  EXPECT_EQ(thinning.cards_for(101), 50U);
  EXPECT_EQ(thinning.cards_for(0), 1U) << "never all";
  EXPECT_EQ(thinning.error(200), 0.0);
  EXPECT_EQ(thinning.enlargement(200), 1.0);
  double error = 0.0;
  for (const std::uint32_t left : {150U, 100U, 30U, 10U, 1U}) {
    EXPECT_GT(thinning.error(left), error);
    error = thinning.error(left);
    EXPECT_NEAR(thinning.enlargement(left) / std::sqrt(200.0 / left), 1.0, 0.4);
  }
  const std::uint32_t stop = 10;
  const simplify::CostCurve curve = thinning.curve(thinning.error(stop));
  EXPECT_LE(simplify::removable_faces(curve), 400U - 2 * stop);
}

TEST(LooseCards, AttributesOfTheOthersStay) {
  const Mesh mesh = built(tree(200)).mesh;
  CornerAttributes corners;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    corners.texcoord.push_back({float(h / 3), float(h % 3)});
  const Attributes attributes = to_wedges(mesh, std::move(corners));
  const ReducedShape result = reduced(mesh, 300, attributes);
  EXPECT_TRUE(validate(result.shape.mesh, result.shape.attributes).empty());
  const CornerAttributes carried = to_corners(result.shape.mesh, result.shape.attributes);
  std::uint32_t found = 0;
  for (std::uint32_t h = 0; h < result.shape.mesh.halfedge_count(); ++h) {
    if (carried.texcoord[h].x < 4'800.0F) continue;
    EXPECT_EQ(carried.texcoord[h].x, std::floor(carried.texcoord[h].x));
    EXPECT_EQ(carried.texcoord[h].y, float(h % 3));
    ++found;
  }
  EXPECT_EQ(found, 6 * (result.cards.cards - result.cards.removed));
}

TEST(LooseCards, MeshOfCardsAlone) {
  Soup soup = leaf(true);
  for (int i = 1; i < 64; ++i)
    soup = join(std::move(soup), leaf(true), {float(i % 8) * 2.0F, float(i / 8) * 2.0F, 0.0F});
  const Mesh mesh = built(std::move(soup)).mesh;
  const ReducedShape result = reduced(mesh, 64);
  expect_valid(result.shape.mesh);
  EXPECT_EQ(result.report.faces_reached, 64U);
  EXPECT_EQ(result.cards.removed, 48U);
  EXPECT_DOUBLE_EQ(result.cards.enlarged, 2.0);
  EXPECT_EQ(reduced(mesh, 1).report.faces_reached, 4U);
}

TEST(LooseCards, SameBytesForAnyThreadCount) {
  const Mesh mesh = built(tree(200)).mesh;
  std::vector<ReducedShape> results;
  for (const unsigned threads : {1U, 3U}) {
    const ThreadLimit limit(threads);
    results.push_back(reduced(mesh, 300));
  }
  EXPECT_TRUE(is_identical(results[0].shape.mesh, results[1].shape.mesh));
}

}  // namespace
}  // namespace mesher::test
