#include "engine/mesh/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <type_traits>

#include "engine/mesh/circulators.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

static_assert(!std::is_convertible_v<Vertex, Face> && !std::is_constructible_v<Vertex, Face>,
              "ids of different kinds must not mix");
static_assert(std::is_trivially_copyable_v<Vertex>);

template <class Range>
auto listed(const Range& range) {
  std::vector<typename std::decay_t<decltype(range.begin())>::value_type> items;
  for (const auto item : range)
    items.push_back(item);
  return items;
}

TEST(Mesh, NextPreviousAndFaceAreArithmetic) {
  for (std::uint32_t f = 0; f < 4; ++f) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Halfedge h = Mesh::halfedge(Face(f), c);
      EXPECT_EQ(Mesh::face(h), Face(f));
      EXPECT_EQ(Mesh::next(h), Mesh::halfedge(Face(f), (c + 1) % 3));
      EXPECT_EQ(Mesh::prev(Mesh::next(h)), h);
    }
  }
}

TEST(Mesh, OriginArrayIsAnIndexBuffer) {
  const Soup soup = cube();
  const Mesh mesh = built(cube()).mesh;
  ASSERT_EQ(mesh.origins().size_bytes(), soup.corners.size() * sizeof(std::uint32_t));
  EXPECT_EQ(std::memcmp(mesh.origins().data(), soup.corners.data(), mesh.origins().size_bytes()),
            0);
  EXPECT_EQ(mesh.positions().size_bytes(), soup.positions.size() * 12);
}

TEST(Mesh, RingOfInteriorVertexHasEachNeighborOnce) {
  const Mesh mesh = built(torus(9, 7)).mesh;
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    const auto ring = listed(vertices_around(mesh, Vertex(i)));
    EXPECT_EQ(ring.size(), 6U);
    EXPECT_EQ(std::set<Vertex>(ring.begin(), ring.end()).size(), 6U);
    EXPECT_EQ(listed(faces_around(mesh, Vertex(i))).size(), 6U);
    for (const Vertex n : ring)
      EXPECT_TRUE(mesh.find_edge(Vertex(i), n).is_valid());
  }
}

TEST(Mesh, RingOfBoundaryVertexHasOneNeighborMoreThanFaces) {
  const Mesh mesh = built(grid(3)).mesh;
  const Vertex corner(0);  // two faces
  EXPECT_TRUE(mesh.is_boundary(corner));
  EXPECT_EQ(listed(faces_around(mesh, corner)).size(), 2U);
  EXPECT_EQ(listed(halfedges_around(mesh, corner)).size(), 2U);
  const auto ring = listed(vertices_around(mesh, corner));
  EXPECT_EQ(ring, (std::vector<Vertex>{Vertex(1), Vertex(5), Vertex(4)}));  // counterclockwise
  EXPECT_EQ(mesh.valence(corner), 3U);
  const auto edges = listed(edges_around(mesh, corner));
  EXPECT_TRUE(mesh.is_boundary(edges.front()));
  EXPECT_TRUE(mesh.is_boundary(edges.back()));
  EXPECT_FALSE(mesh.is_boundary(edges[1]));
}

TEST(Mesh, RingOfIsolatedVertexIsEmpty) {
  Soup soup = tetrahedron();
  soup.positions.push_back(glm::vec3(5.0F));
  const Mesh mesh = built(std::move(soup), {.keep_isolated_vertices = true}).mesh;
  EXPECT_TRUE(listed(vertices_around(mesh, Vertex(4))).empty());
  EXPECT_FALSE(mesh.is_boundary(Vertex(4)));
  EXPECT_EQ(mesh.valence(Vertex(4)), 0U);
}

TEST(Mesh, FindsHalfedgesAndEdgesInBothDirections) {
  const Mesh mesh = built(grid(1)).mesh;  // faces 0 1 3, 0 3 2
  EXPECT_TRUE(mesh.find_halfedge(Vertex(0), Vertex(1)).is_valid());
  EXPECT_FALSE(mesh.find_halfedge(Vertex(1), Vertex(0)).is_valid());
  EXPECT_EQ(mesh.find_edge(Vertex(1), Vertex(0)), mesh.find_edge(Vertex(0), Vertex(1)));
  EXPECT_FALSE(mesh.find_edge(Vertex(1), Vertex(2)).is_valid());
  EXPECT_EQ(mesh.count_edges(), 5U);
}

TEST(Mesh, BothHalfedgesMapToTheSameEdge) {
  const Mesh mesh = built(torus(5, 4)).mesh;
  std::set<Edge> edges;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const Edge e = mesh.edge(Halfedge(h));
    EXPECT_EQ(e, mesh.edge(mesh.twin(Halfedge(h))));
    edges.insert(e);
  }
  EXPECT_EQ(edges.size(), mesh.count_edges());
}

TEST(Mesh, EditsLogExactlyTheElementsTheyChange) {
  Mesh mesh = built(cube()).mesh;
  EXPECT_TRUE(mesh.changes().is_whole(GpuArray::origin));
  mesh.changes().clear();
  mesh.set_position(Vertex(3), {1, 2, 3});
  EXPECT_EQ(mesh.position(Vertex(3)), glm::vec3(1, 2, 3));
  EXPECT_EQ(mesh.changes().merged(GpuArray::position), (std::vector<ChangedRange>{{3, 4}}));
  EXPECT_TRUE(mesh.changes().merged(GpuArray::origin).empty());
  const Edge e = mesh.find_edge(Vertex(0), Vertex(1));
  mesh.set_sharpness(e, 2.0F);
  expect_valid(mesh);
  std::size_t noted = 0;
  for (const ChangedRange r : mesh.changes().merged(GpuArray::edge_class))
    noted += r.end - r.begin;
  EXPECT_EQ(noted, 2U);
  EXPECT_EQ(mesh.edge_class(Mesh::halfedge(e)), EdgeClass::crease);
  EXPECT_EQ(mesh.edge_class(mesh.twin(Mesh::halfedge(e))), EdgeClass::crease);
}

TEST(Mesh, Takes44BytesPerFace) {
  const Mesh mesh = built(torus(300, 200)).mesh;
  EXPECT_LE(static_cast<double>(mesh.memory_bytes()) / mesh.face_count(), 44.6);
}

TEST(Mesh, RoundTripsThroughItsArrays) {
  Mesh mesh = built(cube()).mesh;
  MeshArrays arrays = MeshArrays::take(std::move(mesh));
  const Mesh again = std::move(arrays).finish();
  expect_valid(again);
  EXPECT_EQ(again.face_count(), 12U);
}

}  // namespace
}  // namespace mesher::test
