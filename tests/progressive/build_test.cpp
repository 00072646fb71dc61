#include "engine/progressive/build.h"

#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>
#include <optional>
#include <random>
#include <set>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/mesh/creases.h"
#include "engine/simplify/simplify.h"
#include "tests/progressive/checks.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/watched.h"

namespace mesher::test {
namespace {

/// Fails unless the full detail equals the input, with ids mapped by the sources.
void expect_is_input(progressive::Progressive& progressive, const Mesh& input) {
  progressive::ProgressiveMesh& mesh = progressive.mesh;
  mesh.go_to(mesh.split_count());
  const Mesh& full = mesh.mesh();
  ASSERT_EQ(full.vertex_count(), input.vertex_count());
  ASSERT_EQ(full.face_count(), input.face_count());
  for (std::uint32_t v = 0; v < full.vertex_count(); ++v) {
    const Vertex source = progressive.vertex_source[v];
    ASSERT_EQ(0, std::memcmp(&full.position(Vertex(v)), &input.position(source), 12));
    ASSERT_EQ(full.sharpness(Vertex(v)), input.sharpness(source));
  }
  std::vector<Halfedge> place(input.halfedge_count());
  for (std::uint32_t f = 0; f < full.face_count(); ++f) {
    Halfedge from = progressive.face_source[f];
    for (std::uint32_t c = 0; c < 3; ++c, from = Mesh::next(from))
      place[from.index()] = Mesh::halfedge(Face(f), c);
  }
  for (std::uint32_t i = 0; i < input.halfedge_count(); ++i) {
    const Halfedge h(i);
    const Halfedge to = place[i];
    ASSERT_TRUE(to.is_valid());
    ASSERT_EQ(progressive.vertex_source[full.origin(to).index()], input.origin(h));
    ASSERT_EQ(full.sharpness(to), input.sharpness(h));
    ASSERT_EQ(full.twin(to), input.twin(h).is_valid() ? place[input.twin(h).index()] : Halfedge{});
  }
}

Mesh tagged(Mesh mesh, float angle_deg, float sharpness) {
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    if (i % 7 == 0) mesh.set_sharpness(mesh.edge(Halfedge(i)), sharpness);
  }
  tag_creases_by_angle(mesh, glm::radians(angle_deg));
  return mesh;
}

void examine(const Mesh& input, const simplify::SimplifyOptions& options) {
  progressive::Progressive progressive = progressive::make_progressive(input, options);
  EXPECT_EQ(progressive.mesh.level(), 0U);
  EXPECT_EQ(progressive.mesh.base_face_count(), progressive.report.faces_reached);
  examine_levels(progressive.mesh, 40);
  expect_is_input(progressive, input);
  progressive::ProgressiveMesh again = appended(progressive.mesh);
  expect_same(progressive.mesh, again);
}

TEST(BuildProgressive, FullDetailIsTheInputAndEveryLevelIsValid) {
  const Mesh meshes[] = {
      built(torus(30, 20)).mesh, built(grid(20)).mesh,
      built(join(torus(9, 8), join(grid(6), cube(), {0, 9, 0}), {9, 0, 0})).mesh};
  for (const Mesh& mesh : meshes) {
    for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
      SCOPED_TRACE(key(static_cast<simplify::CostPolicy>(p)));
      examine(mesh, {.target_faces = 1, .cost = static_cast<simplify::CostPolicy>(p)});
    }
  }
}

TEST(BuildProgressive, RandomSoupsBecomeProgressiveMeshes) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    examine(build_mesh(random_soup(seed)).mesh, {.target_faces = 1});
    ASSERT_FALSE(HasFailure());
  }
}

TEST(BuildProgressive, EveryLevelListsBowTieCopies) {
  const Mesh input = built(bow_tie({torus(20, 12), grid(12), cube(), grid(5)})).mesh;
  examine(input, {.target_faces = 1});
  progressive::Progressive progressive = progressive::make_progressive(input, {.target_faces = 1});
  progressive::ProgressiveMesh& mesh = progressive.mesh;
  std::set<Vertex> names;
  for (std::uint32_t level = 0; level <= mesh.split_count(); ++level) {
    mesh.go_to(level);
    expect_valid(mesh.mesh());
    ASSERT_EQ(mesh.mesh().bow_tie_copies().size(), 4U) << level;
    for (const BowTieCopy& copy : mesh.mesh().bow_tie_copies()) {
      ASSERT_EQ(mesh.mesh().position(copy.v), glm::vec3(0.0F));
      names.insert(copy.v);
    }
  }
  EXPECT_GT(names.size(), 4U) << "no copy was merged into another vertex";
  for (const BowTieCopy& copy : mesh.mesh().bow_tie_copies())
    EXPECT_TRUE(input.is_bow_tie_copy(progressive.vertex_source[copy.v.index()]));
}

TEST(BuildProgressive, CopiesMovedByACollapseAreNotListed) {
  const Mesh input = built(bow_tie({cube(), cube(), cube()})).mesh;
  ASSERT_EQ(input.bow_tie_copies().size(), 3U);
  const Halfedge h = input.find_halfedge(Vertex(4), Vertex(0));
  const simplify::CollapseRecord moved{.halfedge = h,
                                       .twin = input.twin(h),
                                       .removed = Vertex(4),
                                       .kept = Vertex(0),
                                       .position = {0, 0, 0.5F}};
  progressive::Progressive progressive = progressive::build_progressive(input, {&moved, 1});
  for (const std::uint32_t level : {0U, 1U, 0U}) {
    progressive.mesh.go_to(level);
    expect_valid(progressive.mesh.mesh());
    EXPECT_EQ(progressive.mesh.mesh().bow_tie_copies().size(), 2U);
  }
}

TEST(BuildProgressive, KeepsCreasesAndSharpVertices) {
  Mesh mesh = built(join(torus(14, 9), grid(8), {9, 0, 0})).mesh;
  mesh.set_sharpness(Vertex(5), 2.0F);
  mesh.set_sharpness(Vertex(50), kInfinitelySharp);
  examine(tagged(mesh, 40.0F, 1.25F), {.target_faces = 1});
  examine(tagged(mesh, 180.0F, kInfinitelySharp), {.target_faces = 40});
}

TEST(BuildProgressive, SameForAnyThreadCount) {
  const Mesh mesh = built(torus(120, 90)).mesh;
  std::optional<progressive::Progressive> first;
  for (const unsigned threads : {1U, 2U, 5U}) {
    const ThreadLimit limit(threads);
    progressive::Progressive progressive =
        progressive::make_progressive(mesh, {.target_faces = 200});
    if (first) {
      expect_same(first->mesh, progressive.mesh);
      EXPECT_EQ(first->vertex_source, progressive.vertex_source);
      EXPECT_EQ(first->face_source, progressive.face_source);
    } else {
      first = std::move(progressive);
    }
  }
}

TEST(BuildProgressive, RanksKeepDependentCollapsesInOrder) {
  const Mesh mesh = built(torus(120, 90)).mesh;
  simplify::CollapseRecorder recorder;
  EXPECT_EQ(simplify::simplify(Mesh(mesh), {.target_faces = 100, .observer = &recorder})
                .report.faces_reached,
            100U);
  for (const simplify::CollapseRecord& c : recorder.records())
    ASSERT_LT(c.rank, simplify::CollapseRecord::kRanks);
  // Of two collapses with the same kept vertex, the later has at least the rank of the earlier.
  std::vector<std::uint32_t> rank(mesh.vertex_count(), 0);
  for (const simplify::CollapseRecord& c : recorder.records()) {
    ASSERT_GE(c.rank, rank[c.kept.index()]);
    ASSERT_GE(c.rank, rank[c.removed.index()]);
    rank[c.kept.index()] = c.rank;
  }
}

TEST(BuildProgressive, WithoutCollapsesHasOnlyTheBase) {
  const Mesh mesh = built(cube()).mesh;
  progressive::Progressive progressive = progressive::build_progressive(mesh, {});
  EXPECT_EQ(progressive.mesh.split_count(), 0U);
  expect_valid_level(progressive.mesh);
  expect_is_input(progressive, mesh);
  progressive::Progressive empty = progressive::make_progressive(Mesh(), {});
  EXPECT_EQ(empty.mesh.mesh().vertex_count(), 0U);
}

TEST(BuildProgressive, StopsWhenCanceled) {
  const Mesh mesh = built(torus(30, 20)).mesh;
  simplify::CollapseRecorder recorder;
  EXPECT_GT(simplify::simplify(Mesh(mesh), {.observer = &recorder}).report.collapses, 0U);
  Progress progress;
  progress.cancel();
  EXPECT_THROW(progressive::build_progressive(mesh, recorder.records(), &progress), Cancelled);
}

TEST(BuildProgressive, HasOneProgress) {
  const Mesh mesh = built(torus(300, 200)).mesh;
  const auto make = [&](Progress* progress) {
    (void)progressive::make_progressive(mesh, {.target_faces = 100, .progress = progress});
  };
  expect_one_progress(watched(make),
                      {"simplifying", "preparing", "simplifying", "finishing", "recording"});
}

TEST(BuildProgressive, CanBeCanceledAtAnyMoment) {
  const Mesh mesh = built(torus(kSanitized ? 200 : 800, 500)).mesh;
  const auto make = [&](Progress* progress) {
    (void)progressive::make_progressive(mesh, {.target_faces = 100, .progress = progress});
  };
  cancel_at_many_moments("making a progressive mesh", make);
}

TEST(GoToLevel, ReachesTheLevelInSteps) {
  progressive::ProgressiveMesh mesh =
      progressive::make_progressive(built(torus(60, 40)).mesh, {.target_faces = 100}).mesh;
  progressive::ProgressiveMesh other = mesh;
  for (const std::uint32_t level : {mesh.split_count(), 7U, mesh.split_count() / 2, 0U}) {
    Progress progress;
    go_to_level(mesh, level, &progress);
    other.go_to(level);
    EXPECT_EQ(mesh.level(), level);
    EXPECT_TRUE(is_identical(mesh.mesh(), other.mesh()));
  }
}

}  // namespace
}  // namespace mesher::test
