#include "engine/simplify/new_intersections.h"

#include <gtest/gtest.h>

#include "engine/mesh/mesh_editor.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using analysis::FacePair;

/// Two triangles: the first lies in the plane z = 0, the second crosses it where x is `x`.
Mesh crossing(float x) {
  Soup soup;
  soup.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {x, 1, -1}, {x, 1, 1}, {x, 2, 0}};
  soup.corners = {0, 1, 2, 3, 4, 5};
  return built(std::move(soup)).mesh;
}

TEST(NewIntersections, FindsPairsThatAppear) {
  EXPECT_EQ(simplify::new_intersections(crossing(9), crossing(1)),
            (std::vector{FacePair{Face(0), Face(1)}}));
}

TEST(NewIntersections, LeavesOutPairsThatWereThere) {
  EXPECT_TRUE(simplify::new_intersections(crossing(0.5), crossing(1)).empty());
}

TEST(NewIntersections, LeavesOutRemovedFaces) {
  Mesh after = crossing(1);
  for (std::uint32_t c = 0; c < 3; ++c)
    MeshEditor(after).set_origin(Mesh::halfedge(Face(1), c), {});
  EXPECT_TRUE(simplify::new_intersections(crossing(9), after).empty());
}

}  // namespace
}  // namespace mesher::test
