#include "engine/subdivide/features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "engine/subdivide/butterfly.h"
#include "engine/subdivide/sharpness.h"
#include "tests/subdivide/compare.h"
#include "tests/subdivide/models.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

std::vector<subdivide::SubdivideOptions> every_crease_rule() {
  std::vector<subdivide::SubdivideOptions> all;
  for (const subdivide::CreaseRules creases :
       {subdivide::CreaseRules::hoppe94, subdivide::CreaseRules::derose98}) {
    for (const subdivide::BoundaryRounding boundary : kBoundaries) {
      for (const subdivide::CreaseDecay decay : kDecays)
        all.push_back({.creases = creases, .boundary = boundary, .decay = decay});
    }
  }
  return all;
}

/// Sharpness that remains on the edge of `h` at its origin, computed from the mesh.
float left_at_origin(const Mesh& mesh, Halfedge h, subdivide::CreaseDecay decay) {
  const float sharpness = mesh.sharpness(h);
  if (decay == subdivide::CreaseDecay::uniform) return subdivide::decayed(sharpness);
  subdivide::SemiSharpSum at_end;
  at_end.add(sharpness);
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge other(i);
    const bool is_at_end =
        mesh.origin(other) == mesh.origin(h) || mesh.target(other) == mesh.origin(h);
    const bool is_counted = mesh.edge(other).index() == i && mesh.edge(other) != mesh.edge(h);
    if (is_at_end && is_counted && !mesh.is_boundary(other)) at_end.add(mesh.sharpness(other));
  }
  return subdivide::chaikin_decayed(sharpness, at_end);
}

/// `level`, made from `coarse`, as a mesh with the remaining sharpness.
Mesh with_sharpness(const Mesh& coarse, const subdivide::Level& level,
                    subdivide::CreaseDecay decay) {
  MeshArrays arrays;
  arrays.position = level.position;
  arrays.origin = level.origin;
  arrays.twin = level.twin;
  arrays.outgoing = level.outgoing;
  arrays.sharpness.assign(level.origin.size(), 0.0F);
  for (std::uint32_t i = 0; i < coarse.halfedge_count(); ++i) {
    const Halfedge h(i);
    if (coarse.is_boundary(h) || coarse.sharpness(h) <= 0.0F) continue;
    const Halfedge half = subdivide::first_half(h);
    arrays.sharpness[half.index()] = left_at_origin(coarse, h, decay);
    arrays.sharpness[level.twin[half.index()].index()] = left_at_origin(coarse, h, decay);
  }
  if (!coarse.vertex_sharpnesses().empty()) {
    arrays.vertex_sharpness.assign(level.position.size(), 0.0F);
    for (std::uint32_t v = 0; v < coarse.vertex_count(); ++v)
      arrays.vertex_sharpness[v] = subdivide::decayed(coarse.sharpness(Vertex(v)));
  }
  arrays.bow_tie_copies.assign(coarse.bow_tie_copies().begin(), coarse.bow_tie_copies().end());
  return std::move(arrays).finish();
}

/// A sharp edge in a form independent of list order: the lower vertex comes first.
struct EdgeFact {
  float sharpness = 0.0F;
  std::array<float, 2> left{};
  friend bool operator==(const EdgeFact&, const EdgeFact&) = default;
};
using EdgeFacts = std::map<VertexPair, EdgeFact>;

EdgeFacts edge_facts(const subdivide::Features& features, const subdivide::LevelView& level) {
  EdgeFacts facts;
  for (const subdivide::SharpEdge& edge : features.edges()) {
    const std::array<std::uint32_t, 2> end{level.origin[edge.h.index()].index(),
                                           level.origin[Mesh::next(edge.h).index()].index()};
    for (std::size_t side = 0; side < 2; ++side)
      EXPECT_EQ(features.vertices()[edge.end[side]].v, Vertex(end[side]));
    EdgeFact fact{edge.sharpness, edge.left};
    if (end[0] > end[1]) std::swap(fact.left[0], fact.left[1]);
    EXPECT_TRUE(facts.emplace(pair_of(end[0], end[1]), fact).second) << "an edge is listed twice";
  }
  return facts;
}

struct VertexFact {
  float own = 0.0F;
  subdivide::VertexKind kind = subdivide::VertexKind::smooth;
  std::vector<std::uint32_t> across;  ///< the vertices at the other ends, sorted
  friend bool operator==(const VertexFact&, const VertexFact&) = default;
};
using VertexFacts = std::map<std::uint32_t, VertexFact>;

VertexFacts vertex_facts(const subdivide::Features& features) {
  VertexFacts facts;
  for (const subdivide::SharpVertex& vertex : features.vertices()) {
    VertexFact fact{vertex.own, vertex.kind, {}};
    for (const std::uint32_t i : features.at(vertex))
      fact.across.push_back(features.other_end(features.edges()[i], vertex).v.index());
    std::ranges::sort(fact.across);
    EXPECT_TRUE(facts.emplace(vertex.v.index(), fact).second) << "a vertex is listed twice";
  }
  return facts;
}

void expect_next_is_scan(const Model& model, const subdivide::SubdivideOptions& options,
                         int levels) {
  Mesh mesh = model.mesh;
  subdivide::Features features = subdivide::features_of(mesh, options);
  for (int i = 1; i <= levels; ++i) {
    SCOPED_TRACE("level " + std::to_string(i));
    const subdivide::Level level =
        subdivide::midpoint_step(subdivide::view_of(mesh), options, false);
    features = subdivide::next_features(features, level, options);
    mesh = with_sharpness(mesh, level, options.decay);
    const subdivide::Features scanned = subdivide::features_of(mesh, options);
    EXPECT_TRUE(edge_facts(features, level.view()) == edge_facts(scanned, level.view()));
    EXPECT_TRUE(vertex_facts(features) == vertex_facts(scanned));
  }
}

TEST(Features, NextLevelMatchesAFullScan) {
  for (const subdivide::SubdivideOptions& options : every_crease_rule()) {
    SCOPED_TRACE("creases " + std::to_string(int(options.creases)) + ", boundary " +
                 std::to_string(int(options.boundary)) + ", decay " +
                 std::to_string(int(options.decay)));
    for (const Model& model : models()) {
      if (model.mesh.face_count() > 150) continue;
      SCOPED_TRACE(model.name);
      expect_next_is_scan(model, options, 2);
    }
  }
}

TEST(Features, AreExactlyTheSharpEdges) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    const Mesh& mesh = model.mesh;
    std::map<VertexPair, float> expected;
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
      const Halfedge h(i);
      const float sharpness = mesh.is_boundary(h) || mesh.sharpness(h) >= subdivide::kSharpForEver
                                  ? kInfinitelySharp
                                  : mesh.sharpness(h);
      if (sharpness > 0.0F)
        expected[pair_of(mesh.origin(h).index(), mesh.target(h).index())] = sharpness;
    }
    std::map<VertexPair, float> found;
    for (const auto& [ends, fact] :
         edge_facts(subdivide::features_of(mesh, {}), subdivide::view_of(mesh)))
      found[ends] = fact.sharpness;
    EXPECT_TRUE(found == expected);
  }
}

/// Kinds of the vertices that are not smooth.
std::map<std::uint32_t, subdivide::VertexKind> kinds(
    const Mesh& mesh, const subdivide::SubdivideOptions& options = {}) {
  std::map<std::uint32_t, subdivide::VertexKind> result;
  for (const auto& [v, fact] : vertex_facts(subdivide::features_of(mesh, options)))
    result[v] = fact.kind;
  return result;
}

Mesh creased(Soup soup, const std::vector<std::uint32_t>& path) {
  Mesh mesh = built(std::move(soup)).mesh;
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    mesh.set_sharpness(mesh.find_edge(Vertex(path[i]), Vertex(path[i + 1])), kInfinitelySharp);
  return mesh;
}

using Kinds = std::map<std::uint32_t, subdivide::VertexKind>;

TEST(Features, VertexKindsOfKnownMeshes) {
  using enum subdivide::VertexKind;
  // The crease runs through the middle of a fan of six, with three faces on each side. The two
  // neighbors on it are darts.
  EXPECT_EQ(kinds(creased(bipyramid(6), {2, 0, 5})),
            (Kinds{{0, regular_crease}, {2, dart}, {5, dart}}));
  EXPECT_EQ(kinds(creased(bipyramid(6), {2, 0, 4})), (Kinds{{0, crease}, {2, dart}, {4, dart}}));
  EXPECT_EQ(kinds(creased(bipyramid(7), {2, 0, 5})), (Kinds{{0, crease}, {2, dart}, {5, dart}}));
  EXPECT_EQ(kinds(creased(bipyramid(6), {2, 0, 5, 1})),
            (Kinds{{0, regular_crease}, {1, dart}, {2, dart}, {5, crease}}));
  EXPECT_EQ(
      kinds(creased(bipyramid(6), {2, 0, 5}), {.creases = subdivide::CreaseRules::derose98})[0],
      crease);
  EXPECT_TRUE(kinds(built(octahedron()).mesh).empty());
}

TEST(Features, ThreeSharpEdgesMakeACorner) {
  Mesh mesh = creased(bipyramid(6), {2, 0, 5});
  mesh.set_sharpness(mesh.find_edge(Vertex(0), Vertex(3)), 0.5F);
  EXPECT_EQ(kinds(mesh)[0], subdivide::VertexKind::corner);
  EXPECT_EQ(kinds(creased(grid(3), {5, 6}))[6], subdivide::VertexKind::dart);
  EXPECT_EQ(kinds(creased(grid(3), {4, 5}))[4],
            subdivide::VertexKind::corner);  // two of them on the boundary
}

TEST(Features, BoundaryVerticesWithThreeFacesAreRegular) {
  const Mesh mesh = built(grid(2)).mesh;  // the diagonals rise to the right
  EXPECT_EQ(kinds(mesh), (Kinds{{0, subdivide::VertexKind::crease},
                                {1, subdivide::VertexKind::regular_crease},
                                {2, subdivide::VertexKind::crease},
                                {3, subdivide::VertexKind::regular_crease},
                                {5, subdivide::VertexKind::regular_crease},
                                {6, subdivide::VertexKind::crease},
                                {7, subdivide::VertexKind::regular_crease},
                                {8, subdivide::VertexKind::crease}}));
  const auto rounded = kinds(mesh, {.boundary = subdivide::BoundaryRounding::edge_and_corner});
  EXPECT_EQ(rounded.at(2), subdivide::VertexKind::corner);  // one face
  EXPECT_EQ(rounded.at(0), subdivide::VertexKind::crease);  // two faces
}

TEST(Features, VertexIsACornerWhileItsSharpnessLasts) {
  Mesh mesh = built(icosahedron()).mesh;
  mesh.set_sharpness(Vertex(3), 1.5F);
  mesh.set_sharpness(Vertex(7), 12.0F);
  subdivide::Features features = subdivide::features_of(mesh, {});
  EXPECT_EQ(vertex_facts(features).at(3).own, 1.5F);
  EXPECT_EQ(vertex_facts(features).at(7).own, kInfinitelySharp);
  const subdivide::Level level = subdivide::midpoint_step(subdivide::view_of(mesh), {}, false);
  features = subdivide::next_features(features, level, {});
  EXPECT_EQ(vertex_facts(features).at(3).own, 0.5F);
  const subdivide::Level last = subdivide::midpoint_step(level.view(), {}, false);
  features = subdivide::next_features(features, last, {});
  EXPECT_EQ(vertex_facts(features),
            (VertexFacts{{7, {kInfinitelySharp, subdivide::VertexKind::corner, {}}}}));
}

TEST(Features, BowTieCopiesArePermanentCorners) {
  const Mesh mesh = built(bow_tie({icosahedron(), grid(2)})).mesh;
  ASSERT_EQ(mesh.bow_tie_copies().size(), 2U);
  subdivide::Features features = subdivide::features_of(mesh, {});
  const subdivide::Level level = subdivide::midpoint_step(subdivide::view_of(mesh), {}, false);
  for (const bool is_next : {false, true}) {
    if (is_next) features = subdivide::next_features(features, level, {});
    for (const BowTieCopy& copy : mesh.bow_tie_copies()) {
      EXPECT_EQ(vertex_facts(features).at(copy.v.index()).own, kInfinitelySharp);
      EXPECT_EQ(vertex_facts(features).at(copy.v.index()).kind, subdivide::VertexKind::corner);
    }
  }
}

}  // namespace
}  // namespace mesher::test
