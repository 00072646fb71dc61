// Copies of a bow-tie vertex under subdivision. The tests over all models compare the engine with
// OpenSubdiv and the oracles.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/subdivide/level.h"
#include "engine/subdivide/subdivide.h"
#include "tests/subdivide/compare.h"
#include "tests/subdivide/models.h"
#include "tests/subdivide/opensubdiv_reference.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

std::vector<const Model*> models_with_bow_ties() {
  std::vector<const Model*> found;
  for (const Model& model : models()) {
    if (!model.mesh.bow_tie_copies().empty()) found.push_back(&model);
  }
  return found;
}

Mesh without_copies(const Mesh& mesh) {
  MeshArrays arrays = MeshArrays::take(Mesh(mesh));
  arrays.bow_tie_copies.clear();
  return std::move(arrays).finish();
}

TEST(BowTies, ModelsContainBowTies) {
  EXPECT_GE(models_with_bow_ties().size(), 7U);
}

TEST(BowTies, CopiesKeepTheirPositionAtEveryLevelAndTheLimit) {
  for (std::uint32_t levels = 0; levels <= 3; ++levels) {
    for (const subdivide::SubdivideOptions& options : every_rule(levels)) {
      for (const Model* model : models_with_bow_ties()) {
        SCOPED_TRACE(model->name);
        const Mesh fine = subdivide::subdivide(model->mesh, options).mesh;
        expect_valid(fine);
        ASSERT_TRUE(is_equal(fine.bow_tie_copies(), model->mesh.bow_tie_copies()));
        for (const BowTieCopy& copy : fine.bow_tie_copies())
          EXPECT_EQ(fine.position(copy.v), model->mesh.position(copy.v));
      }
    }
  }
}

TEST(BowTies, UnpinnedCopiesWouldDriftApartUnderLoop) {
  const Mesh cubes = built(bow_tie({cube(), cube()})).mesh;
  const auto [first, second] = std::pair(cubes.bow_tie_copies()[0].v, cubes.bow_tie_copies()[1].v);
  const Mesh fine = subdivide::subdivide(without_copies(cubes), {.levels = 3}).mesh;
  EXPECT_GT(glm::distance(fine.position(first), fine.position(second)), 0.3F);
}

TEST(BowTies, CopiesAreInfinitelySharpCorners) {
  for (const subdivide::SubdivideOptions& options : every_rule(3)) {
    for (const Model* model : models_with_bow_ties()) {
      SCOPED_TRACE(model->name);
      Mesh tagged = without_copies(model->mesh);
      for (const BowTieCopy& copy : model->mesh.bow_tie_copies())
        tagged.set_sharpness(copy.v, kInfinitelySharp);
      const subdivide::Subdivided expected = subdivide::subdivide(tagged, options);
      const subdivide::Subdivided found = subdivide::subdivide(model->mesh, options);
      EXPECT_TRUE(is_equal(found.mesh.positions(), expected.mesh.positions()));
      EXPECT_TRUE(is_equal(found.mesh.sharpnesses(), expected.mesh.sharpnesses()));
      EXPECT_TRUE(is_equal(std::span<const glm::vec3>(found.limit_normal),
                           std::span<const glm::vec3>(expected.limit_normal)));
    }
  }
}

// The only difference from OpenSubdiv, which averages over the edges of both fans.
TEST(BowTies, ChaikinAveragesEachFanSeparately) {
  Mesh mesh = built(bow_tie({cube(), cube()})).mesh;
  mesh.set_sharpness(mesh.find_edge(Vertex(0), Vertex(4)), 1.5F);
  mesh.set_sharpness(mesh.find_edge(Vertex(15), Vertex(11)), 2.5F);
  const OpenSubdivReference reference(mesh, subdivide::BoundaryRounding::edge_only,
                                      subdivide::CreaseDecay::chaikin, 1);
  const Mesh fine = subdivide::subdivide(mesh, {.creases = subdivide::CreaseRules::derose98,
                                                .decay = subdivide::CreaseDecay::chaikin})
                        .mesh;
  const Halfedge half = subdivide::first_half(mesh.find_halfedge(Vertex(0), Vertex(4)));
  EXPECT_EQ(fine.sharpness(half), 0.5F);
  const std::uint32_t middle = fine.target(half).index();
  EXPECT_EQ(sharpness_of(reference.level(1), 0, middle), 0.75);
}

TEST(BowTies, PinningAddsNoSharpnessToTheResult) {
  for (const subdivide::SubdivideOptions& options : every_rule(2)) {
    const Mesh fine =
        subdivide::subdivide(built(bow_tie({cube(), tetrahedron()})).mesh, options).mesh;
    EXPECT_TRUE(fine.vertex_sharpnesses().empty());
    EXPECT_TRUE(std::ranges::all_of(fine.sharpnesses(), [](float s) { return s == 0.0F; }));
  }
}

}  // namespace
}  // namespace mesher::test
