#include "engine/simplify/surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// Checks S1 and S2: the shapes and quadrics are those of the current positions.
void expect_up_to_date(const simplify::Surface& surface) {
  const simplify::Surface fresh(Mesh(surface.mesh()), {});
  const Mesh& mesh = surface.mesh();
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    EXPECT_EQ(surface.shape(Face(f)).normal, fresh.shape(Face(f)).normal);
    EXPECT_EQ(surface.shape(Face(f)).area, fresh.shape(Face(f)).area);
  }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const simplify::VertexState& now = surface.state(Vertex(v));
    const simplify::VertexState& expected = fresh.state(Vertex(v));
    EXPECT_EQ(now.position.x, expected.position.x);
    for (const auto entry : {&simplify::Quadric<float>::xx, &simplify::Quadric<float>::xy,
                             &simplify::Quadric<float>::xz, &simplify::Quadric<float>::yy,
                             &simplify::Quadric<float>::yz, &simplify::Quadric<float>::zz}) {
      EXPECT_NEAR(now.quadric.*entry, expected.quadric.*entry, 1e-5) << v;
    }
    EXPECT_NEAR(now.quadric.g.z, expected.quadric.g.z, 1e-5) << v;
  }
}

// The boundary of the sheet adds planes of its own.
TEST(Surface, RecomputeFollowsMovedVertices) {
  simplify::Surface surface(built(grid(6)).mesh, {});
  for (std::uint32_t v = 0; v < surface.mesh().vertex_count(); v += 3) {
    const glm::vec3 p =
        surface.mesh().position(Vertex(v)) + glm::vec3(0.1F, -0.05F, std::sin(float(v)));
    surface.mesh().set_position(Vertex(v), p);
    surface.move_and_clear_quadric(Vertex(v), p);
  }
  surface.recompute();
  expect_up_to_date(surface);
}

TEST(Surface, RecomputeLeavesAnUnchangedSurfaceAsItIs) {
  simplify::Surface surface(built(torus(12, 8)).mesh, {});
  surface.recompute();
  expect_up_to_date(surface);
}

}  // namespace
}  // namespace mesher::test
