#include "engine/mesh/circulators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

template <Turn direction, Connectivity C>
std::vector<Halfedge> walk(const C& connectivity, Halfedge start, bool& is_closed) {
  std::vector<Halfedge> visited;
  Circulator<C, direction> at(connectivity, start);
  do {
    visited.push_back(*at);
  } while (at.advance());
  is_closed = at.is_closed();
  return visited;
}

std::vector<Halfedge> out_of(const Mesh& mesh, Vertex v) {
  std::vector<Halfedge> out;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    if (mesh.origin(Halfedge(i)) == v) out.push_back(Halfedge(i));
  }
  return out;
}

TEST(Circulator, VisitsEveryHalfedgeOfAnInteriorVertexOnceInBothDirections) {
  const Mesh mesh = built(cube()).mesh;
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    const Halfedge start = mesh.outgoing(Vertex(i));
    bool is_closed = false;
    const std::vector<Halfedge> ccw = walk<Turn::ccw>(mesh, start, is_closed);
    EXPECT_TRUE(is_closed);
    std::vector<Halfedge> sorted = ccw;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, out_of(mesh, Vertex(i)));
    std::vector<Halfedge> cw = walk<Turn::cw>(mesh, start, is_closed);
    EXPECT_TRUE(is_closed);
    std::reverse(cw.begin() + 1, cw.end());
    EXPECT_EQ(cw, ccw);
  }
}

TEST(Circulator, EndsAtTheBoundaryAndSaysSo) {
  const Mesh mesh = built(grid(4)).mesh;
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vertex v(i);
    if (!mesh.is_boundary(v)) continue;
    bool is_closed = true;
    EXPECT_EQ(walk<Turn::ccw>(mesh, mesh.outgoing(v), is_closed).size(), out_of(mesh, v).size());
    EXPECT_FALSE(is_closed);
    is_closed = true;
    EXPECT_EQ(walk<Turn::cw>(mesh, mesh.outgoing(v), is_closed).size(), 1U);
    EXPECT_FALSE(is_closed);
  }
}

TEST(Circulator, ATwinViewWalksLikeTheMesh) {
  const Mesh mesh = built(grid(4)).mesh;
  const TwinView twins{mesh.twins()};
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    EXPECT_EQ(twins.rotate_ccw(h), mesh.rotate_ccw(h));
    EXPECT_EQ(twins.rotate_cw(h), mesh.rotate_cw(h));
  }
}

TEST(FirstOfFan, IsTheBoundaryHalfedgeOrTheHalfedgeItself) {
  const Mesh open = built(grid(4)).mesh;
  for (std::uint32_t i = 0; i < open.halfedge_count(); ++i) {
    const Vertex v = open.origin(Halfedge(i));
    EXPECT_EQ(first_of_fan(open, Halfedge(i)),
              open.is_boundary(v) ? open.outgoing(v) : Halfedge(i));
  }
  const Mesh closed = built(cube()).mesh;
  for (std::uint32_t i = 0; i < closed.halfedge_count(); ++i)
    EXPECT_EQ(first_of_fan(closed, Halfedge(i)), Halfedge(i));
}

}  // namespace
}  // namespace mesher::test
