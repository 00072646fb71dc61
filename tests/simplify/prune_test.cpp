#include "engine/simplify/prune.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/analysis/distance.h"
#include "engine/core/parallel.h"
#include "engine/mesh/corner_attributes.h"
#include "engine/simplify/simplify_model.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// Forty tiny cubes (480 faces, 320 vertices), then a torus of 4,800 faces. Without pruning,
/// reaching only the faces of the cubes costs an error larger than the cubes.
Soup specks_before_torus() {
  Soup soup = scaled(cube(), 1e-5F);
  for (int i = 1; i < 40; ++i)
    soup = join(std::move(soup), scaled(cube(), 1e-5F), {0.01F * float(i), 0.0F, 0.0F});
  return join(std::move(soup), torus(60, 40));
}

std::uint32_t components(const Mesh& mesh) {
  return statistics(mesh).components;
}

TEST(Prune, SmallPartsAreRemovedInFavorOfTheRest) {
  const Mesh mesh = built(torus_with_specks(40, 0.02F)).mesh;
  const simplify::SimplifyOptions options{.target_faces = 200};
  const simplify::Simplified plain = simplify::simplify(Mesh(mesh), options);
  const simplify::Simplified result = simplify::simplify_pruned(Mesh(mesh), options);
  expect_valid(result.mesh);
  const simplify::SimplifyReport& report = result.report;
  EXPECT_EQ(report.pruned_parts, 40U);
  EXPECT_EQ(report.pruned_faces, 480U);
  EXPECT_NEAR(report.largest_pruned, 0.02 * std::sqrt(3.0), 1e-5);
  EXPECT_EQ(report.error_unpruned, plain.report.estimated_error);
  EXPECT_LT(report.largest_pruned, report.error_unpruned);
  EXPECT_EQ(report.reason, simplify::StopReason::target_reached);
  EXPECT_EQ(report.faces_before, mesh.face_count());
  EXPECT_EQ(report.vertices_before, mesh.vertex_count());
  EXPECT_EQ(result.mesh.face_count(), 200U);
  EXPECT_EQ(components(result.mesh), 1U);
  EXPECT_LT(report.estimated_error, 0.5 * plain.report.estimated_error);
}

TEST(Prune, ErrorIncludesPrunedParts) {
  // Small plates with bumps, farther from the torus than their own size.
  Soup plate = scaled(grid(4), 0.03F);
  for (std::size_t i = 0; i < plate.positions.size(); ++i)
    plate.positions[i].z = i % 2 == 0 ? 0.0F : 0.01F;
  Soup soup = torus(60, 40);
  for (int i = 0; i < 30; ++i)
    soup = join(std::move(soup), plate, {0.0F, 0.0F, 2.0F + 0.2F * float(i)});
  const Mesh mesh = built(std::move(soup)).mesh;
  const simplify::Simplified result = simplify::simplify_pruned(Mesh(mesh), {.target_faces = 12});
  ASSERT_GT(result.report.pruned_parts, 0U);
  const double forward =
      analysis::surface_distance(mesh, result.mesh, {.samples = 50'000}).forward.rms;
  EXPECT_NEAR(result.report.estimated_error / forward, 1.0, 0.3);
}

TEST(Prune, NothingIsPrunedWhenTheErrorIsSmaller) {
  const Mesh mesh = built(torus_with_specks(40, 0.02F)).mesh;
  const simplify::SimplifyOptions options{.target_faces = 4'000};
  const simplify::Simplified result = simplify::simplify_pruned(Mesh(mesh), options);
  EXPECT_EQ(result.report.pruned_parts, 0U);
  EXPECT_EQ(result.report.pruned_faces, 0U);
  EXPECT_TRUE(is_identical(result.mesh, simplify::simplify(Mesh(mesh), options).mesh));
}

TEST(Prune, LargestPartIsKept) {
  for (const std::uint32_t target : {0U, 4U}) {
    const Mesh mesh = built(torus_with_specks(10, 0.02F)).mesh;
    const simplify::Simplified result =
        simplify::simplify_pruned(Mesh(mesh), {.target_faces = target});
    EXPECT_GE(result.mesh.face_count(), 4U);
    EXPECT_EQ(components(result.mesh), 1U);
  }
  const Mesh alone = built(torus(20, 12)).mesh;
  const simplify::Simplified result = simplify::simplify_pruned(Mesh(alone), {.target_faces = 20});
  EXPECT_TRUE(
      is_identical(result.mesh, simplify::simplify(Mesh(alone), {.target_faces = 20}).mesh));
  EXPECT_EQ(simplify::simplify_pruned(Mesh(), {}).report.reason,
            simplify::StopReason::already_there);
}

/// Only the specks are removed. The ids must then lead to the positions and corners of the input.
TEST(Prune, IdsMapToTheInput) {
  const Mesh mesh = built(specks_before_torus()).mesh;
  const simplify::Simplified result =
      simplify::simplify_pruned(Mesh(mesh), {.target_faces = 4'800});
  ASSERT_EQ(result.report.pruned_parts, 40U);
  ASSERT_EQ(result.report.collapses, 0U);
  EXPECT_EQ(result.report.reason, simplify::StopReason::target_reached);
  ASSERT_EQ(result.vertex_source.size(), result.mesh.vertex_count());
  ASSERT_EQ(result.face_source.size(), result.mesh.face_count());
  for (std::uint32_t v = 0; v < result.mesh.vertex_count(); ++v)
    ASSERT_EQ(result.mesh.position(Vertex(v)), mesh.position(result.vertex_source[v]));
  for (std::uint32_t h = 0; h < result.mesh.halfedge_count(); ++h) {
    const Halfedge source = Mesh::halfedge(result.face_source[h / 3], h % 3);
    ASSERT_EQ(result.vertex_source[result.mesh.origin(Halfedge(h)).index()], mesh.origin(source));
  }
  EXPECT_TRUE(std::is_sorted(result.face_source.begin(), result.face_source.end()));
}

TEST(Prune, AttributesFollowTheRemainingParts) {
  const Mesh mesh = built(specks_before_torus()).mesh;
  CornerAttributes corners;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    corners.group.push_back(f < 480 ? 0 : 1 + f % 5);
  corners.groups.resize(6);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    corners.texcoord.push_back({float(mesh.origin(Halfedge(h)).index()), 0.0F});
  const Attributes attributes = to_wedges(mesh, std::move(corners));
  for (const std::uint32_t target : {4'800U, 300U}) {
    const simplify::SimplifiedModel model =
        simplify::simplify_model(Mesh(mesh), attributes, {.target_faces = target}, true);
    const simplify::Simplified& result = model.simplified;
    ASSERT_EQ(result.report.pruned_parts, 40U) << target;
    EXPECT_TRUE(validate(result.mesh, model.attributes).empty());
    ASSERT_EQ(model.attributes.group.size(), result.mesh.face_count());
    for (std::uint32_t f = 0; f < result.mesh.face_count(); ++f)
      ASSERT_EQ(model.attributes.group[f], 1 + result.face_source[f].index() % 5);
    const CornerAttributes carried = to_corners(result.mesh, model.attributes);
    ASSERT_EQ(carried.texcoord.size(), result.mesh.halfedge_count());
    for (const glm::vec2& t : carried.texcoord)
      ASSERT_GE(t.x, 320.0F) << "earlier vertices belong to the cubes";
  }
}

TEST(Prune, KeepsSharpnessOfTheRemainingParts) {
  Mesh mesh = built(specks_before_torus()).mesh;
  for (std::uint32_t h = 1440; h < mesh.halfedge_count(); h += 300)
    mesh.set_sharpness(mesh.edge(Halfedge(h)), 2.0F);
  mesh.set_sharpness(Vertex(500), 3.0F);
  const std::uint32_t creases = statistics(mesh).crease_edges;
  const simplify::Simplified result =
      simplify::simplify_pruned(Mesh(mesh), {.target_faces = 4'800});
  ASSERT_EQ(result.report.pruned_parts, 40U);
  EXPECT_EQ(statistics(result.mesh).crease_edges, creases);
  EXPECT_EQ(result.mesh.sharpness(Vertex(500 - 320)), 3.0F);
}

TEST(Prune, PartsThatTouchAtABowTieCountAsOne) {
  // A small cube at the corner of a large plate stays. Two small cubes that touch are removed
  // together.
  const Soup small = scaled(cube(), 1e-4F);
  Soup plate = grid(40);
  for (glm::vec3& p : plate.positions)
    p.z = 0.001F * p.x * p.y;
  const Mesh touching = built(bow_tie({plate, small})).mesh;
  ASSERT_EQ(components(touching), 2U);
  ASSERT_EQ(touching.bow_tie_copies().size(), 2U);
  const simplify::Simplified kept = simplify::simplify_pruned(Mesh(touching), {.target_faces = 20});
  expect_valid(kept.mesh);
  EXPECT_EQ(kept.report.pruned_parts, 0U);
  EXPECT_EQ(kept.mesh.bow_tie_copies().size(), 2U);

  const Mesh apart = built(join(plate, bow_tie({small, small}), {20.0F, 20.0F, 0.5F})).mesh;
  ASSERT_EQ(components(apart), 3U);
  const simplify::Simplified pruned = simplify::simplify_pruned(Mesh(apart), {.target_faces = 20});
  expect_valid(pruned.mesh);
  EXPECT_EQ(pruned.report.pruned_parts, 1U);
  EXPECT_EQ(pruned.report.pruned_faces, 24U);
  EXPECT_TRUE(pruned.mesh.bow_tie_copies().empty());
}

TEST(Prune, KeepsIsolatedVertices) {
  Soup soup = torus_with_specks(20, 0.02F);
  soup.positions.push_back({1.0F, 2.0F, 3.0F});
  BuildOptions keep;
  keep.keep_isolated_vertices = true;
  const Mesh mesh = built(std::move(soup), keep).mesh;
  ASSERT_EQ(statistics(mesh).isolated_vertices, 1U);
  const simplify::Simplified result = simplify::simplify_pruned(Mesh(mesh), {.target_faces = 100});
  EXPECT_EQ(result.report.pruned_parts, 20U);
  EXPECT_EQ(statistics(result.mesh).isolated_vertices, 1U);
  EXPECT_EQ(result.vertex_source.back(), Vertex(mesh.vertex_count() - 1));
}

TEST(Prune, CertifiedBoundCoversTheWholeInput) {
  Soup soup = torus_with_specks(40, 0.02F);
  soup = join(std::move(soup), scaled(cube(), 0.02F), {0.0F, 0.0F, 3.0F});  // far from the rest
  const Mesh mesh = built(std::move(soup)).mesh;
  const simplify::Simplified result =
      simplify::simplify_pruned(Mesh(mesh), {.target_faces = 200, .certifies = true});
  ASSERT_EQ(result.report.pruned_parts, 41U);
  const double max = analysis::surface_distance(mesh, result.mesh).two_sided().max;
  EXPECT_GT(max, 2.0) << "the distance of the cube";
  EXPECT_GE(result.report.certified_bound, max);
}

TEST(Prune, SameBytesForAnyThreadCount) {
  const Mesh mesh = built(torus_with_specks(40, 0.02F)).mesh;
  std::vector<simplify::Simplified> results;
  for (const unsigned threads : {1U, 3U}) {
    const ThreadLimit limit(threads);
    results.push_back(simplify::simplify_pruned(Mesh(mesh), {.target_faces = 200}));
  }
  EXPECT_TRUE(is_identical(results[0].mesh, results[1].mesh));
  EXPECT_EQ(results[0].report.estimated_error, results[1].report.estimated_error);
}

}  // namespace
}  // namespace mesher::test
