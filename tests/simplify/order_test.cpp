#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "engine/simplify/morton.h"
#include "engine/simplify/reorder.h"
#include "engine/simplify/simplify.h"
#include "tests/simplify/replay.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

TEST(MortonOrder, IsAPermutationThatKeepsNeighborsClose) {
  std::mt19937 random(3);
  std::vector<glm::vec3> positions;
  for (int i = 0; i < 4'000; ++i) {
    positions.emplace_back(float(random() % 1000), float(random() % 1000), float(random() % 1000));
  }
  Array<Vertex> all;
  for (std::uint32_t v = 0; v < positions.size(); ++v)
    all.emplace_back(v);
  for (const simplify::MortonGrid& grid :
       {simplify::MortonGrid{}, simplify::MortonGrid{.bits = 7, .shift = 0.999F}}) {
    Array<Vertex> order = simplify::morton_order(positions, all, grid);
    double step = 0.0;
    for (std::size_t i = 1; i < order.size(); ++i) {
      step += double{glm::distance(positions[order[i].index()], positions[order[i - 1].index()])};
    }
    EXPECT_LT(step / static_cast<double>(order.size()), 120.0);  // 660 for a random order
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, all);
  }
}

TEST(MortonOrder, AcceptsEqualPointsAndNoPoints) {
  const std::vector<glm::vec3> positions(100, glm::vec3(3.0F));
  Array<Vertex> all;
  for (std::uint32_t v = 0; v < positions.size(); ++v)
    all.emplace_back(v);
  EXPECT_EQ(simplify::morton_order(positions, all, {}), all) << "equal points keep their order";
  EXPECT_TRUE(simplify::morton_order(positions, {}, {}).empty());
}

TEST(Reorder, GivesTheSameSurfaceWithNewIds) {
  Mesh mesh = built(join(torus(20, 13), grid(9), {9, 0, 0})).mesh;
  mesh.set_sharpness(mesh.edge(Halfedge(17)), 2.5F);
  mesh.set_sharpness(Vertex(5), 1.0F);
  const simplify::Reordered order = simplify::reorder_by_position(mesh);
  expect_valid(order.mesh);
  EXPECT_TRUE(is_same_surface(order.mesh, mesh));
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vertex source = order.vertex_source[v];
    EXPECT_EQ(order.mesh.position(Vertex(v)), mesh.position(source));
    EXPECT_EQ(order.mesh.sharpness(Vertex(v)), mesh.sharpness(source));
  }
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const Halfedge source = Mesh::halfedge(order.face_source[h / 3], h % 3);
    EXPECT_EQ(order.mesh.sharpness(Halfedge(h)), mesh.sharpness(source));
    EXPECT_EQ(order.vertex_source[order.mesh.origin(Halfedge(h)).index()], mesh.origin(source));
  }
}

TEST(Reorder, BowTieCopiesAreListedWithNewIds) {
  const Mesh mesh = built(bow_tie({torus(20, 13), grid(9), cube()})).mesh;
  const simplify::Reordered order = simplify::reorder_by_position(mesh);
  expect_valid(order.mesh);
  ASSERT_EQ(order.mesh.bow_tie_copies().size(), 3U);
  for (const BowTieCopy& copy : order.mesh.bow_tie_copies())
    EXPECT_TRUE(mesh.is_bow_tie_copy(order.vertex_source[copy.v.index()]));
}

TEST(ResultOrder, SourcesMapToTheInput) {
  const Mesh mesh = built(join(torus(30, 20), grid(12), {9, 0, 0})).mesh;
  for (const simplify::ResultOrder order :
       {simplify::ResultOrder::input, simplify::ResultOrder::fill_holes}) {
    const simplify::Simplified result = simplify::simplify(
        Mesh(mesh),
        {.target_faces = 400, .placement = simplify::Placement::endpoint, .order = order});
    expect_valid(result.mesh);
    ASSERT_EQ(result.vertex_source.size(), result.mesh.vertex_count());
    ASSERT_EQ(result.face_source.size(), result.mesh.face_count());
    // A face keeps at least one corner in its position, or it has lost all of them to neighboring
    // vertices.
    std::uint32_t with_a_corner = 0;
    for (std::uint32_t f = 0; f < result.mesh.face_count(); ++f) {
      bool has = false;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const Vertex now = result.mesh.origin(Mesh::halfedge(Face(f), c));
        const Vertex before = mesh.origin(Mesh::halfedge(result.face_source[f], c));
        has |= result.vertex_source[now.index()] == before;
      }
      with_a_corner += has ? 1 : 0;
    }
    EXPECT_GT(with_a_corner, result.mesh.face_count() / 2);
  }
}

TEST(ResultOrder, InputOrderIsSortedAndFillHolesKeepsSlots) {
  const Mesh mesh = built(torus(30, 20)).mesh;
  const simplify::Simplified in_order = simplify::simplify(Mesh(mesh), {.target_faces = 1'000});
  EXPECT_TRUE(std::is_sorted(in_order.vertex_source.begin(), in_order.vertex_source.end()));
  EXPECT_TRUE(std::is_sorted(in_order.face_source.begin(), in_order.face_source.end()));
  const simplify::Simplified filled = simplify::simplify(
      Mesh(mesh), {.target_faces = 1'000, .order = simplify::ResultOrder::fill_holes});
  EXPECT_TRUE(is_same_surface(in_order.mesh, filled.mesh));
  for (std::uint32_t f = 0; f < filled.mesh.face_count(); ++f) {
    const std::uint32_t source = filled.face_source[f].index();
    EXPECT_TRUE(source == f || source >= filled.mesh.face_count());
  }
  std::uint32_t moved = 0;
  for (std::uint32_t v = 0; v < filled.mesh.vertex_count(); ++v) {
    const std::uint32_t source = filled.vertex_source[v].index();
    EXPECT_TRUE(source == v || source >= filled.mesh.vertex_count());
    moved += source != v ? 1 : 0;
  }
  EXPECT_LE(moved, mesh.vertex_count() - filled.mesh.vertex_count());
}

}  // namespace
}  // namespace mesher::test
