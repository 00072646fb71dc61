#include "engine/subdivide/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <set>

#include "engine/core/error.h"
#include "tests/subdivide/models.h"
#include "tests/subdivide/plain_mesh.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using mesher::subdivide::Point;

// Face (a, b, c) has the children (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca).
static_assert(subdivide::first_half(Halfedge(0)) == Halfedge(0) &&
              subdivide::second_half(Halfedge(0)) == Halfedge(3));
static_assert(subdivide::first_half(Halfedge(1)) == Halfedge(4) &&
              subdivide::second_half(Halfedge(1)) == Halfedge(7));
static_assert(subdivide::first_half(Halfedge(2)) == Halfedge(8) &&
              subdivide::second_half(Halfedge(2)) == Halfedge(2));
static_assert(subdivide::second_half(Halfedge(5)) == Halfedge(14));

TEST(Children, HalvesAreDistinctAndMapBackToTheirEdge) {
  constexpr std::uint32_t kHalfedges = 3 * 100;
  std::set<std::uint32_t> halves;
  for (std::uint32_t i = 0; i < kHalfedges; ++i) {
    const Halfedge h(i);
    EXPECT_EQ(subdivide::whole_of_second(subdivide::second_half(h)), h) << i;
    EXPECT_EQ(subdivide::second_half(h).index() / 12, i / 3) << i;
    halves.insert({subdivide::first_half(h).index(), subdivide::second_half(h).index()});
  }
  EXPECT_EQ(halves.size(), 2U * kHalfedges);
}

/// The next level with complete connectivity and placeholder positions.
subdivide::Level refined(const Mesh& mesh) {
  subdivide::Level level = subdivide::refine(subdivide::view_of(mesh), false, nullptr,
                                             [](const subdivide::EdgeSite&) { return Point(); });
  std::fill_n(level.position.begin(), mesh.vertex_count(), glm::vec3(0.0F));
  subdivide::write_outgoing(subdivide::view_of(mesh), level);
  return level;
}

Mesh mesh_of(subdivide::Level level) {
  MeshArrays arrays;
  arrays.sharpness.assign(level.origin.size(), 0.0F);
  arrays.position = std::move(level.position);
  arrays.origin = std::move(level.origin);
  arrays.twin = std::move(level.twin);
  arrays.outgoing = std::move(level.outgoing);
  return std::move(arrays).finish();
}

TEST(Refine, HalvesOfAnEdgeMeetAtItsVertex) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    const subdivide::Level level = refined(model.mesh);
    const Mesh fine = mesh_of(level);
    for (std::uint32_t i = 0; i < model.mesh.halfedge_count(); ++i) {
      const Halfedge h(i);
      ASSERT_EQ(fine.origin(subdivide::first_half(h)), model.mesh.origin(h));
      ASSERT_EQ(fine.target(subdivide::second_half(h)), model.mesh.target(h));
      ASSERT_EQ(fine.target(subdivide::first_half(h)), subdivide::edge_vertex(level, h));
      ASSERT_EQ(fine.origin(subdivide::second_half(h)), subdivide::edge_vertex(level, h));
    }
  }
}

TEST(Refine, ConnectivityIsValid) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    const Mesh fine = mesh_of(refined(model.mesh));
    expect_valid(fine);
    EXPECT_EQ(topology(fine), topology(model.mesh));
    EXPECT_EQ(fine.count_edges(), 2 * model.mesh.count_edges() + 3 * model.mesh.face_count());
  }
}

TEST(Refine, RingOfANewBoundaryVertexStartsOnTheBoundary) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    const Mesh& mesh = model.mesh;
    const subdivide::Level level = refined(mesh);
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
      const Halfedge h(i);
      const Halfedge out = level.outgoing[subdivide::edge_vertex(level, h).index()];
      EXPECT_EQ(level.twin[out.index()].is_valid(), !mesh.is_boundary(h));
      EXPECT_EQ(out, subdivide::second_half(std::min(h, mesh.twin(h))));
    }
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
      EXPECT_EQ(level.outgoing[v].is_valid(), !mesh.is_isolated(Vertex(v)));
  }
}

TEST(Refine, NumbersEdgesInTheOrderOfTheFaces) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    const Mesh& mesh = model.mesh;
    const subdivide::Level level = refined(mesh);
    std::map<VertexPair, std::uint32_t> number;
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
      const Halfedge h(i);
      const auto next = mesh.vertex_count() + static_cast<std::uint32_t>(number.size());
      const VertexPair ends = pair_of(mesh.origin(h).index(), mesh.target(h).index());
      const std::uint32_t v = number.emplace(ends, next).first->second;
      ASSERT_EQ(subdivide::edge_vertex(level, h), Vertex(v)) << i;
    }
    EXPECT_EQ(number.size(), mesh.count_edges());
    EXPECT_EQ(number.size(), subdivide::count_edges(mesh.twins()));
    EXPECT_EQ(level.position.size(), mesh.vertex_count() + number.size());
  }
}

TEST(Refine, RequestsAndStoresEachEdgePositionOnce) {
  const Mesh mesh = built(grid(40)).mesh;
  std::mutex mutex;
  std::multiset<std::uint32_t> asked;
  const subdivide::Level level = subdivide::refine(
      subdivide::view_of(mesh), false, nullptr, [&](const subdivide::EdgeSite& edge) {
        const std::lock_guard lock(mutex);
        asked.insert(edge.h.index());
        EXPECT_EQ(edge.next, Mesh::next(edge.h));
        EXPECT_EQ(edge.prev, Mesh::prev(edge.h));
        EXPECT_EQ(edge.twin, mesh.twin(edge.h));
        return Point(glm::vec3(static_cast<float>(edge.h.index()), 1.0F, 2.0F));
      });
  EXPECT_EQ(asked.size(), mesh.count_edges());
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge lower = std::min(Halfedge(i), mesh.twin(Halfedge(i)));
    EXPECT_EQ(asked.count(i), lower == Halfedge(i) ? 1U : 0U) << i;
    EXPECT_EQ(level.position[subdivide::edge_vertex(level, Halfedge(i)).index()],
              glm::vec3(static_cast<float>(lower.index()), 1.0F, 2.0F));
  }
}

TEST(Refine, LastLevelHasOnlyFaces) {
  const Mesh mesh = built(torus(20, 30)).mesh;
  const auto nowhere = [](const subdivide::EdgeSite&) { return Point(); };
  const subdivide::Level bare = subdivide::refine(subdivide::view_of(mesh), true, nullptr, nowhere);
  EXPECT_TRUE(bare.twin.empty());
  EXPECT_TRUE(bare.outgoing.empty());
  EXPECT_TRUE(bare.origin == refined(mesh).origin);
}

TEST(Refine, SameForAnyThreadCount) {
  const Mesh mesh = built(torus(70, 80)).mesh;  // several chunks
  const auto run = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return refined(mesh);
  };
  const subdivide::Level one = run(1);
  const subdivide::Level many = run(3);
  EXPECT_TRUE(one.origin == many.origin);
  EXPECT_TRUE(one.twin == many.twin);
  EXPECT_TRUE(one.outgoing == many.outgoing);
}

TEST(Refine, ThrowsWhenCanceled) {
  const Mesh mesh = built(octahedron()).mesh;
  Progress progress;
  progress.cancel();
  const auto nowhere = [](const subdivide::EdgeSite&) { return Point(); };
  EXPECT_THROW((void)subdivide::refine(subdivide::view_of(mesh), false, &progress, nowhere),
               Cancelled);
}

}  // namespace
}  // namespace mesher::test
