#include "engine/render/line_edges.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/core/parallel.h"
#include "engine/mesh/collapse.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

TEST(LineEdges, FindEachBoundaryAndCreaseOnce) {
  Mesh mesh = build_mesh(test::grid(4)).mesh;
  EXPECT_EQ(find_line_edges(mesh).boundaries.size(), 16U);
  EXPECT_TRUE(find_line_edges(mesh).creases.empty());
  std::uint32_t inner = 0;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    if (mesh.is_boundary(h) || mesh.sharpness(h) > 0.0F) continue;
    mesh.set_sharpness(mesh.edge(h), 1.0F);
    ++inner;
  }
  const LineEdges edges = find_line_edges(mesh);
  EXPECT_EQ(edges.creases.size(), inner);
  EXPECT_EQ(edges.boundaries.size(), 16U) << "a sharp boundary edge counts only as boundary";
}

TEST(LineEdges, UpdateEqualsAFullSearch) {
  Mesh mesh = build_mesh(test::grid(30)).mesh;
  LineEdges edges = find_line_edges(mesh);
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    mesh.changes().clear();
    for (int i = 0; i < round; ++i) {
      const Halfedge h(static_cast<std::uint32_t>(random() % mesh.halfedge_count()));
      mesh.set_sharpness(mesh.edge(h), static_cast<float>(random() % 4));
    }
    update_line_edges(mesh, mesh.changes().merged(GpuArray::edge_class), edges);
    ASSERT_EQ(edges, find_line_edges(mesh));
  }
}

TEST(LineEdges, WeightGrowsWithSharpness) {
  EXPECT_EQ(line_weight(0.0F), 0.0F);
  EXPECT_EQ(line_weight(kInfinitelySharp), 1.0F);
  float before = 0.0F;
  for (int i = 1; i <= 1000; ++i) {  // strictly increasing and without jumps
    const float weight = line_weight(0.01F * static_cast<float>(i));
    EXPECT_GT(weight, before);
    EXPECT_LT(weight, before + 0.006F);
    before = weight;
  }
  EXPECT_LT(before, 0.9F) << "a sharpness of 10 looks different from infinity";
  Mesh mesh = build_mesh(test::grid(4)).mesh;
  const Edge inner = mesh.find_edge(Vertex(6), Vertex(7));
  mesh.set_sharpness(inner, 2.0F);
  const LineEdges edges = find_line_edges(mesh);
  EXPECT_EQ(edges.creases, (std::vector<Line>{{Mesh::halfedge(inner), 0.5F}}));
  EXPECT_EQ(edges.boundaries.front().weight, 1.0F);
}

TEST(LineEdges, FollowCollapses) {
  Mesh mesh = build_mesh(test::grid(12)).mesh;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); i += 13)
    mesh.set_sharpness(mesh.edge(Halfedge(i)), 1.0F);
  LineEdges edges = find_line_edges(mesh);
  std::mt19937 random(6);
  for (int i = 0; i < 2000 && mesh.face_count() > 20; ++i) {
    const Halfedge h(static_cast<std::uint32_t>(random() % mesh.halfedge_count()));
    if (!check_collapse(mesh, h).is_legal()) continue;
    mesh.changes().clear();
    collapse(mesh, h, mesh.position(mesh.target(h)));
    update_line_edges(mesh, mesh.changes().merged(GpuArray::edge_class, 0, mesh.halfedge_count()),
                      edges);
    ASSERT_EQ(edges, find_line_edges(mesh));
  }
}

TEST(LineEdges, SameForAnyThreadCount) {
  const Mesh mesh = build_mesh(test::grid(400)).mesh;
  const LineEdges many = find_line_edges(mesh);
  const ThreadLimit one(1);
  EXPECT_EQ(find_line_edges(mesh), many);
}

}  // namespace
}  // namespace mesher::render
