#include "app/edit/edge_list.h"

#include <gtest/gtest.h>

#include "tests/app/edit/editing.h"

namespace mesher::app {
namespace {

TEST(EdgeList, WritesRanges) {
  const auto text = [](std::vector<std::uint32_t> ids) {
    std::vector<Edge> edges;
    for (const std::uint32_t id : ids)
      edges.emplace_back(id);
    return edge_list_text(edges);
  };
  EXPECT_EQ(text({}), "");
  EXPECT_EQ(text({7}), "7");
  EXPECT_EQ(text({0, 1, 2, 5, 7, 8}), "0-2,5,7-8");
}

TEST(EdgeList, ReadsWhatItWrites) {
  const Mesh mesh = build_mesh(test::torus(12, 8)).mesh;
  std::vector<Edge> edges;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.edge(Halfedge(h)) == Edge(h) && h % 3 != 1) edges.emplace_back(h);
  }
  ASSERT_GT(edges.size(), 50U);
  EXPECT_EQ(parse_edge_list(edge_list_text(edges), mesh), edges);
}

TEST(EdgeList, RefusesBadText) {
  const Mesh mesh = build_mesh(test::cube()).mesh;
  for (const char* text : {"", ",", "1,", "1-", "-1", "x", "1 2", "3,2", "5-4", "1,1", "36",
                           "0-4294967295", "4294967296"})
    EXPECT_FALSE(parse_edge_list(text, mesh)) << text;
  // A half-edge that does not name its edge.
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    EXPECT_EQ(parse_edge_list(std::to_string(h), mesh).has_value(),
              mesh.edge(Halfedge(h)) == Edge(h))
        << h;
  }
}

}  // namespace
}  // namespace mesher::app
