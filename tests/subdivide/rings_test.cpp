#include "engine/subdivide/rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/subdivide/butterfly.h"
#include "tests/subdivide/models.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// The half-edges out of an interior vertex, found by walking around it.
std::vector<Halfedge> walked(const subdivide::LevelView& level, Vertex v) {
  std::vector<Halfedge> spokes;
  const Halfedge start = level.outgoing[v.index()];
  Halfedge h = start;
  do {
    spokes.push_back(h);
    h = level.twin[Mesh::prev(h).index()];
  } while (h.is_valid() && h != start && spokes.size() < 1000);
  EXPECT_EQ(h, start) << "vertex " << v.index() << " is on a boundary";
  std::ranges::sort(spokes);
  return spokes;
}

bool is_inside(const subdivide::LevelView& level, Vertex v) {
  const Halfedge h = level.outgoing[v.index()];
  return h.is_valid() && level.twin[h.index()].is_valid();
}

/// Compares every interior vertex; returns how many there were.
std::uint32_t expect_walked(const subdivide::Rings& rings, const subdivide::LevelView& level) {
  std::uint32_t inside = 0;
  for (std::uint32_t v = 0; v < level.vertex_count(); ++v) {
    if (!is_inside(level, Vertex(v))) continue;
    ++inside;
    std::vector<Halfedge> spokes;
    rings.for_each_spoke(level, Vertex(v), [&](Halfedge h) { spokes.push_back(h); });
    EXPECT_EQ(spokes, walked(level, Vertex(v))) << "vertex " << v;
  }
  return inside;
}

/// Refines and compares at every level. From the second level on, some vertex is interior.
void expect_walked_down(const Mesh& mesh, std::uint32_t levels) {
  subdivide::Rings rings(subdivide::view_of(mesh), true);
  expect_walked(rings, subdivide::view_of(mesh));
  subdivide::Level level;
  subdivide::LevelView coarse = subdivide::view_of(mesh);
  for (std::uint32_t i = 1; i <= levels; ++i) {
    SCOPED_TRACE("level " + std::to_string(i));
    subdivide::Level finer = subdivide::midpoint_step(coarse, {}, false);
    rings.descend(coarse.vertex_count());
    level = std::move(finer);
    coarse = level.view();
    const std::uint32_t inside = expect_walked(rings, coarse);
    if (i >= 2) {
      EXPECT_GT(inside, 0U);
    }
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Rings, MatchAWalkAtEveryLevel) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    if (model.mesh.face_count() > 0)
      expect_walked_down(model.mesh, affordable_levels(model.mesh, 3));
  }
}

TEST(Rings, StayValidForVerticesOfEarlierLevels) {
  expect_walked_down(built(tetrahedron()).mesh, 6);
  expect_walked_down(built(fan(5, false)).mesh, 6);
}

TEST(Rings, StoreTheFaceCountOfBaseVertices) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    std::vector<std::uint32_t> faces(model.mesh.vertex_count(), 0);
    for (const Vertex v : model.mesh.origins())
      ++faces[v.index()];
    for (const bool lists_spokes : {false, true}) {
      const subdivide::Rings rings(subdivide::view_of(model.mesh), lists_spokes);
      ASSERT_EQ(rings.base_vertices(), model.mesh.vertex_count());
      for (std::uint32_t v = 0; v < faces.size(); ++v)
        EXPECT_EQ(rings.base_valence(v), faces[v]) << v;
    }
  }
}

TEST(Rings, AreEmptyForAnEmptyMesh) {
  for (const bool lists_spokes : {false, true})
    EXPECT_EQ(subdivide::Rings(subdivide::view_of(Mesh()), lists_spokes).base_vertices(), 0U);
}

}  // namespace
}  // namespace mesher::test
