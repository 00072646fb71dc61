// Copies of bow-tie vertices in simplification: they are pinned and stay listed as copies.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "engine/core/parallel.h"
#include "engine/simplify/simplify.h"
#include "tests/simplify/replay.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// Swaps vertex `v` of the soup with its vertex 0.
Soup with_first(Soup soup, std::uint32_t v) {
  std::swap(soup.positions[0], soup.positions[v]);
  for (std::uint32_t& corner : soup.corners)
    corner = corner == 0 ? v : corner == v ? 0 : corner;
  return soup;
}

/// Closed surfaces only; the corner of a sheet; a vertex in the middle of a side of a sheet.
std::vector<Mesh> meshes_with_bow_ties() {
  std::vector<Mesh> meshes;
  meshes.push_back(built(bow_tie({torus(24, 14), torus(9, 20)})).mesh);
  meshes.push_back(built(bow_tie({torus(15, 10), grid(12), cube(), grid(3)})).mesh);
  meshes.push_back(built(bow_tie({with_first(grid(10), 5), with_first(grid(8), 40)})).mesh);
  return meshes;
}

/// Fails unless the bow tie has as many copies as in the input, at the same position.
void expect_copies_stay(const Mesh& result, const Mesh& input) {
  expect_valid(result);
  ASSERT_EQ(result.bow_tie_copies().size(), input.bow_tie_copies().size());
  for (const BowTieCopy& copy : result.bow_tie_copies())
    EXPECT_EQ(result.position(copy.v), input.position(input.bow_tie_copies()[0].v));
}

TEST(BowTies, CopiesKeepTheirPositionUntilTheLastCollapse) {
  std::size_t renamed = 0;
  for (const Mesh& mesh : meshes_with_bow_ties()) {
    for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
      for (std::size_t k = 0; k < simplify::kPlacements.size(); ++k) {
        SCOPED_TRACE(std::string(key(static_cast<simplify::CostPolicy>(p))) + ", " +
                     std::string(key(static_cast<simplify::Placement>(k))));
        simplify::CollapseRecorder recorder;
        const simplify::Simplified result =
            simplify::simplify(Mesh(mesh), {.cost = static_cast<simplify::CostPolicy>(p),
                                            .placement = static_cast<simplify::Placement>(k),
                                            .observer = &recorder});
        EXPECT_EQ(topology(result.mesh), topology(mesh));
        EXPECT_LT(result.mesh.face_count(), mesh.face_count() / 8);
        expect_copies_stay(result.mesh, mesh);
        EXPECT_TRUE(result.mesh.vertex_sharpnesses().empty());
        for (const BowTieCopy& copy : result.mesh.bow_tie_copies())
          renamed += mesh.is_bow_tie_copy(result.vertex_source[copy.v.index()]) ? 0 : 1;
        const Mesh replayed = replay(mesh, recorder.records(), [&](const Mesh& now, std::size_t) {
          ASSERT_EQ(now.bow_tie_copies().size(), mesh.bow_tie_copies().size());
        });
        expect_copies_stay(replayed, mesh);
      }
    }
  }
  // A collapse may remove the copy itself. The other end then takes its position and its entry.
  EXPECT_GT(renamed, 0U);
}

TEST(BowTies, CopiesAreKeptForEveryTargetOrderAndRule) {
  for (const Mesh& mesh : meshes_with_bow_ties()) {
    for (const std::uint32_t faces : {mesh.face_count(), mesh.face_count() - 1, 200U, 60U}) {
      expect_copies_stay(simplify::simplify(Mesh(mesh), {.target_faces = faces}).mesh, mesh);
    }
    const auto order = simplify::ResultOrder::fill_holes;
    expect_copies_stay(simplify::simplify(Mesh(mesh), {.target_faces = 50, .order = order}).mesh,
                       mesh);
    const auto boundary = simplify::BoundaryRule::lock;
    expect_copies_stay(simplify::simplify(Mesh(mesh), {.boundary = boundary}).mesh, mesh);
    expect_copies_stay(simplify::simplify(Mesh(mesh), {.crease_angle_deg = 20.0F}).mesh, mesh);
  }
  const Mesh small = built(bow_tie({cube(), grid(4)})).mesh;
  expect_copies_stay(simplify::simplify(Mesh(small), {.max_error = 0.05}).mesh, small);
}

TEST(BowTies, CopiesAreKeptForMeshesOfEverySize) {
  for (const float scale : {1e-30F, 1e-12F, 1e15F, 1e30F}) {
    for (const Mesh& unit : meshes_with_bow_ties()) {
      MeshArrays arrays = MeshArrays::take(Mesh(unit));
      for (glm::vec3& p : arrays.position)
        p = scale * (p + glm::vec3(0.3F, 0.7F, 0.1F));
      const Mesh mesh = std::move(arrays).finish();
      expect_copies_stay(simplify::simplify(Mesh(mesh), {}).mesh, mesh);
    }
  }
}

TEST(BowTies, SameBytesForAnyThreadCount) {
  // The mesh is large enough for several regions per round.
  const Mesh mesh = built(bow_tie({torus(150, 90), torus(90, 60), grid(60)})).mesh;
  std::optional<simplify::Simplified> first;
  for (const unsigned threads : {1U, 2U, 5U}) {
    const ThreadLimit limit(threads);
    simplify::Simplified result = simplify::simplify(Mesh(mesh), {.target_faces = 500});
    expect_copies_stay(result.mesh, mesh);
    if (!first) {
      first = std::move(result);
    } else {
      EXPECT_TRUE(is_identical(first->mesh, result.mesh));
    }
  }
}

}  // namespace
}  // namespace mesher::test
