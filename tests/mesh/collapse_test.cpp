#include "engine/mesh/collapse.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/mesh/circulators.h"
#include "engine/mesh/statistics.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using Copies = Array<BowTieCopy>;

/// The oracle collapses in a plain list of triangles, without half-edges, and returns whether the
/// result is a clean manifold of the same topology.
bool may_collapse(const Mesh& mesh, Halfedge h) {
  Soup soup;
  soup.positions.assign(mesh.positions().begin(), mesh.positions().end());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::array<std::uint32_t, 3> t{};
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Vertex v = mesh.origin(Mesh::halfedge(Face(f), c));
      t[c] = (v == mesh.origin(h) ? mesh.target(h) : v).index();
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    soup.corners.insert(soup.corners.end(), t.begin(), t.end());
  }
  const BuildResult result = build_mesh(std::move(soup));
  BuildReport wanted;
  wanted[Repair::isolated_vertices_dropped] = 1;
  for (std::size_t i = 0; i < kRepairs.size(); ++i) {
    if (result.report[static_cast<Repair>(i)] != wanted[static_cast<Repair>(i)]) return false;
  }
  return topology(result.mesh) == topology(mesh);
}

void expect_agrees_with_oracle(const Mesh& mesh) {
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const CollapseCheck check = check_collapse(mesh, Halfedge(i));
    ASSERT_EQ(check.is_legal(), may_collapse(mesh, Halfedge(i)))
        << "half-edge " << i << " of " << mesh.face_count()
        << " faces: " << describe(check.verdict);
  }
}

TEST(CheckCollapse, AgreesWithOracleOnEveryEdgeOfManyMeshes) {
  for (const Soup& soup : {tetrahedron(), cube(), grid(1), grid(2), grid(4), torus(3, 3),
                           torus(5, 4), moebius(5), join(cube(), grid(2), {3, 0, 0})}) {
    expect_agrees_with_oracle(built(Soup(soup)).mesh);
  }
  for (std::uint32_t seed = 0; seed < 400 && !testing::Test::HasFailure(); ++seed) {
    expect_agrees_with_oracle(built(random_soup(seed)).mesh);
  }
}

TEST(CheckCollapse, ReportsTheReasonForEachRejection) {
  const Mesh tetra = built(tetrahedron()).mesh;
  EXPECT_EQ(check_collapse(tetra, Halfedge(0)).verdict, CollapseVerdict::tetrahedron);
  const Mesh triangle = built(soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2})).mesh;
  EXPECT_EQ(check_collapse(triangle, Halfedge(0)).verdict, CollapseVerdict::leaves_vertex);
  const Mesh square = built(grid(1)).mesh;
  const CollapseCheck across = check_collapse(square, square.find_halfedge(Vertex(0), Vertex(3)));
  EXPECT_EQ(across.verdict, CollapseVerdict::pinches_boundary);
  EXPECT_TRUE(across.blamed.is_valid());
  const Mesh ring = built(torus(3, 8)).mesh;  // three around: each ring of three vertices is a loop
  const CollapseCheck around = check_collapse(ring, ring.find_halfedge(Vertex(0), Vertex(8)));
  EXPECT_EQ(around.verdict, CollapseVerdict::link_condition);
  EXPECT_EQ(around.blamed, Vertex(16));
  EXPECT_EQ(describe(CollapseVerdict::link_condition), "link condition");
}

/// Collapses random edges until none is legal and checks all invariants after each collapse.
void collapse_to_the_end(Mesh mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  const Topology before = topology(mesh);
  std::vector<Halfedge> legal;
  for (;;) {
    legal.clear();
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
      if (check_collapse(mesh, Halfedge(i)).is_legal()) legal.emplace_back(i);
    }
    if (legal.empty()) break;
    const Halfedge h = legal[random() % legal.size()];
    const std::uint32_t faces = mesh.face_count();
    const std::uint32_t vertices = mesh.vertex_count();
    const bool is_boundary = mesh.is_boundary(h);
    const glm::vec3 p(static_cast<float>(vertices), 1.0F, 2.0F);
    const CollapseResult result = collapse(mesh, h, p);
    EXPECT_EQ(mesh.position(result.kept), p);
    EXPECT_EQ(mesh.face_count(), faces - (is_boundary ? 1 : 2));
    EXPECT_EQ(mesh.vertex_count(), vertices - 1);
    expect_valid(mesh);
    ASSERT_EQ(topology(mesh), before) << "seed " << seed;
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Collapse, KeepsInvariantsAndTopologyUntilTheLastEdge) {
  std::uint32_t seed = 0;
  for (const Soup& soup :
       {cube(), grid(5), torus(9, 7), moebius(12), join(torus(6, 5), grid(3), {9, 0, 0}),
        bow_tie({cube(), grid(3), cube()})}) {
    for (int run = 0; run < 4; ++run)
      collapse_to_the_end(built(Soup(soup)).mesh, ++seed);
  }
  for (; seed < 300 && !testing::Test::HasFailure(); ++seed) {
    collapse_to_the_end(built(random_soup(seed)).mesh, seed);
  }
}

TEST(Collapse, KeepsBowTieCopiesThatDoNotMove) {
  const auto copies = [](const Mesh& m) {
    return Copies(m.bow_tie_copies().begin(), m.bow_tie_copies().end());
  };
  const auto collapse_at = [](Mesh& m, std::uint32_t removed, std::uint32_t kept, glm::vec3 p) {
    const Halfedge h = m.find_halfedge(Vertex(removed), Vertex(kept));
    ASSERT_TRUE(check_collapse(m, h).is_legal());
    collapse(m, h, p);
    expect_valid(m);
  };
  const Mesh two = built(bow_tie({cube(), cube()})).mesh;
  ASSERT_EQ(copies(two), (Copies{{Vertex(0), Vertex(0)}, {Vertex(15), Vertex(0)}}));
  Mesh mesh = two;  // a neighbor is removed, and the last vertex, a copy, moves into its slot
  collapse_at(mesh, 4, 0, {0, 0, 0});
  EXPECT_EQ(copies(mesh), (Copies{{Vertex(0), Vertex(0)}, {Vertex(4), Vertex(0)}}));
  mesh = two;  // the copy is removed, and its neighbor takes its position
  collapse_at(mesh, 0, 4, {0, 0, 0});
  EXPECT_EQ(copies(mesh), (Copies{{Vertex(0), Vertex(0)}, {Vertex(4), Vertex(0)}}));
  mesh = two;
  collapse_at(mesh, 4, 0, {0, 0, 1});
  EXPECT_TRUE(copies(mesh).empty());
  mesh = two;
  collapse_at(mesh, 0, 4, {0, 0, 1});
  EXPECT_TRUE(copies(mesh).empty());
}

TEST(Collapse, ClosedSurfaceEndsAsTetrahedron) {
  Mesh mesh = built(cube()).mesh;
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (std::uint32_t i = 0; i < mesh.halfedge_count() && !goes_on; ++i) {
      if (!check_collapse(mesh, Halfedge(i)).is_legal()) continue;
      collapse(mesh, Halfedge(i), mesh.position(mesh.target(Halfedge(i))));
      goes_on = true;
    }
  }
  EXPECT_EQ(mesh.face_count(), 4U);
}

TEST(Collapse, LogsEveryChangedArrayElement) {
  Mesh mesh = built(torus(8, 6)).mesh;
  std::mt19937 random(4);
  for (int step = 0; step < 30; ++step) {
    Halfedge h(static_cast<std::uint32_t>(random() % mesh.halfedge_count()));
    if (!check_collapse(mesh, h).is_legal()) continue;
    const std::vector<Vertex> origins(mesh.origins().begin(), mesh.origins().end());
    const std::vector<glm::vec3> positions(mesh.positions().begin(), mesh.positions().end());
    mesh.changes().clear();
    collapse(mesh, h, glm::vec3(1.0F, 2.0F, static_cast<float>(step)));
    std::vector<bool> is_noted(origins.size(), false);
    for (const ChangedRange r : mesh.changes().merged(GpuArray::origin)) {
      for (std::uint32_t i = r.begin; i < std::min<std::uint32_t>(r.end, mesh.halfedge_count());
           ++i)
        is_noted[i] = true;
    }
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
      EXPECT_TRUE(is_noted[i] || mesh.origins()[i] == origins[i]) << i;
    }
    is_noted.assign(positions.size(), false);
    for (const ChangedRange r : mesh.changes().merged(GpuArray::position)) {
      for (std::uint32_t i = r.begin; i < std::min(r.end, mesh.vertex_count()); ++i)
        is_noted[i] = true;
    }
    for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
      EXPECT_TRUE(is_noted[i] || mesh.positions()[i] == positions[i]) << i;
    }
  }
}

TEST(Collapse, CreaseContinuesAndLargerSharpnessWins) {
  Mesh mesh = built(grid(4)).mesh;
  // A crease runs along the row y = 2. One of its edges is collapsed into the next.
  for (std::uint32_t x = 0; x < 4; ++x) {
    mesh.set_sharpness(mesh.find_edge(Vertex(10 + x), Vertex(11 + x)), 2.0F);
  }
  mesh.set_sharpness(mesh.find_edge(Vertex(12), Vertex(18)), 1.0F);
  collapse(mesh, mesh.find_halfedge(Vertex(12), Vertex(13)), mesh.position(Vertex(13)));
  expect_valid(mesh);
  std::size_t creases = 0;
  for (const float s : mesh.sharpnesses())
    creases += s == 2.0F ? 1 : 0;
  EXPECT_EQ(creases, 6U);  // three edges of the row remain
}

TEST(Collapse, ReportsMovedIds) {
  Mesh mesh = built(torus(8, 6)).mesh;
  const std::uint32_t last_vertex = mesh.vertex_count() - 1;
  const glm::vec3 last_position = mesh.position(Vertex(last_vertex));
  const Halfedge h = mesh.find_halfedge(Vertex(10), Vertex(11));
  const CollapseResult result = collapse(mesh, h, glm::vec3(0.0F));
  EXPECT_EQ(result.kept, Vertex(11));
  EXPECT_EQ(result.vertex_move, (CollapseResult::Move{last_vertex, 10}));
  EXPECT_EQ(mesh.position(Vertex(10)), last_position);
  EXPECT_EQ(result.removed_faces, 2U);
}

TEST(Collapse, HubIsNotWalkedForEachSpoke) {
  // A fan of 100,000 faces: checking a rim edge must not walk the ring of the hub each time.
  Soup soup;
  soup.positions.push_back({0, 0, 0});
  constexpr std::uint32_t kSpokes = 100'000;
  for (std::uint32_t i = 0; i < kSpokes; ++i) {
    const float a = 6.2831853F * static_cast<float>(i) / kSpokes;
    soup.positions.push_back({std::cos(a), std::sin(a), 0});
    soup.corners.insert(soup.corners.end(), {0U, i + 1, (i + 1) % kSpokes + 1});
  }
  const Mesh mesh = built(std::move(soup)).mesh;
  std::uint32_t legal = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    legal += check_collapse(mesh, Mesh::halfedge(Face(f), 1)).is_legal() ? 1 : 0;
  }
  EXPECT_EQ(legal, kSpokes);
}

}  // namespace
}  // namespace mesher::test
