// Tests which vertices are bow ties. The build tests cover the rest of the cutter.
#include "engine/mesh/build/manifold_cutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using Copies = Array<BowTieCopy>;

Copies copies_of(const Mesh& mesh) {
  return {mesh.bow_tie_copies().begin(), mesh.bow_tie_copies().end()};
}

/// The list of copies of one bow-tie vertex.
Copies copies(std::initializer_list<std::uint32_t> vertices) {
  Copies all;
  for (const std::uint32_t v : vertices)
    all.push_back({Vertex(v), Vertex(*vertices.begin())});
  return all;
}

TEST(BuildBowTies, ListsCopiesBetweenClosedOrOpenFans) {
  EXPECT_EQ(copies_of(built(bow_tie({tetrahedron(), tetrahedron()})).mesh), copies({0, 7}));
  EXPECT_EQ(copies_of(built(bow_tie({cube(), grid(2), cube()})).mesh), copies({0, 23, 24}));
  EXPECT_EQ(copies_of(built(bow_tie({grid(1), grid(1), grid(1), grid(1)})).mesh),
            copies({0, 13, 14, 15}));
}

TEST(BuildBowTies, MeshesWithoutBowTiesListNone) {
  for (const Soup& soup : {cube(), grid(4), torus(6, 5), join(cube(), cube(), {1, 0, 0})})
    EXPECT_TRUE(built(Soup(soup)).mesh.bow_tie_copies().empty());
}

TEST(BuildBowTies, VerticesOfCutEdgesAreNotListed) {
  Soup solids = join(cube(), cube(), {1.0F, 1.0F, 0.0F});
  for (std::uint32_t& v : solids.corners)
    v = v == 8 ? 2 : v == 12 ? 6 : v;
  const Soup pages = soup_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                             {0, 1, 2, 1, 0, 3, 0, 1, 4});
  for (const Soup& soup : {solids, pages, moebius(16)}) {
    const BuildResult r = built(Soup(soup));
    EXPECT_GT(
        r.report[Repair::non_manifold_vertices_cut] + r.report[Repair::unorientable_edges_cut], 0U);
    EXPECT_TRUE(r.mesh.bow_tie_copies().empty());
  }
}

TEST(BuildBowTies, FanAtACutEdgePinsAllCopiesOfItsVertex) {
  // Two cubes share an edge from vertex 2 to 6. A tetrahedron touches it at vertex 2.
  Soup soup = join(join(cube(), cube(), {1.0F, 1.0F, 0.0F}), tetrahedron(), {0.5F, 0.5F, -3.0F});
  for (std::uint32_t& v : soup.corners)
    v = v == 8 || v == 16 ? 2 : v == 12 ? 6 : v;
  const BuildResult r = built(std::move(soup));
  const Copies found = copies_of(r.mesh);
  EXPECT_EQ(found.size(), 3U);
  for (const auto& [v, first] : found) {
    EXPECT_EQ(r.vertex_source[v.index()], 2U);
    EXPECT_EQ(first, found.front().v);
  }
}

/// Returns the vertices whose fans are not joined by edges of the input, by comparing all faces
/// with each other.
std::set<std::uint32_t> bow_ties_by_brute_force(const BuildResult& r) {
  const Mesh& mesh = r.mesh;
  const auto source = [&](std::uint32_t h) {
    return r.vertex_source[mesh.origin(Halfedge(h)).index()];
  };
  std::map<std::uint32_t, std::vector<std::uint32_t>> corners_at;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    corners_at[source(h)].push_back(h);
  std::set<std::uint32_t> found;
  for (const auto& [v, corners] : corners_at) {
    std::vector<std::uint32_t> group(corners.size());
    std::iota(group.begin(), group.end(), 0U);
    const auto share_an_edge = [&](std::uint32_t g, std::uint32_t h) {
      const auto next = [](std::uint32_t i) { return Mesh::next(Halfedge(i)).index(); };
      const auto prev = [](std::uint32_t i) { return Mesh::prev(Halfedge(i)).index(); };
      return source(next(g)) == source(next(h)) || source(next(g)) == source(prev(h)) ||
             source(prev(g)) == source(next(h)) || source(prev(g)) == source(prev(h));
    };
    for (std::size_t round = 0; round < corners.size(); ++round) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t k = 0; k < corners.size(); ++k) {
          if (share_an_edge(corners[i], corners[k]))
            group[i] = group[k] = std::min(group[i], group[k]);
        }
      }
    }
    if (std::ranges::any_of(group, [](std::uint32_t g) { return g != 0; })) found.insert(v);
  }
  return found;
}

TEST(BuildBowTies, AgreesWithBruteForceOnRandomSoups) {
  std::size_t with_bow_ties = 0;
  std::size_t with_other_copies = 0;
  std::uint32_t compared = 0;
  for (std::uint32_t seed = 0; compared < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const BuildResult r = built(random_soup(seed));
    // The vertices of second sides have the sources of other vertices, but share no edges with
    // them.
    if (r.report[Repair::second_sides_kept] > 0) continue;
    ++compared;
    const std::set<std::uint32_t> expected = bow_ties_by_brute_force(r);
    std::size_t copies = 0;
    for (std::uint32_t v = 0; v < r.mesh.vertex_count(); ++v) {
      const bool is_bow_tie = expected.contains(r.vertex_source[v]);
      ASSERT_EQ(r.mesh.is_bow_tie_copy(Vertex(v)), is_bow_tie) << v;
      copies += is_bow_tie ? 1 : 0;
    }
    for (const auto& [v, first] : r.mesh.bow_tie_copies())
      ASSERT_EQ(r.vertex_source[v.index()], r.vertex_source[first.index()]);
    with_bow_ties += copies > 0 ? 1 : 0;
    with_other_copies += r.report[Repair::non_manifold_vertices_cut] > expected.size() ? 1 : 0;
  }
  EXPECT_GT(with_bow_ties, 100U);
  EXPECT_GT(with_other_copies, 100U);
}

}  // namespace
}  // namespace mesher::test
