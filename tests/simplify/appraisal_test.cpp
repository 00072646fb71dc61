#include "engine/simplify/appraisal.h"

#include <gtest/gtest.h>

#include "engine/mesh/build/build.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// Appraises the removal of the tip of a spire, for which the planes cost 1.
struct RemovedTip {
  RemovedTip() {
    Soup soup = grid(4);
    soup.positions[12].z = 3.0F;
    const simplify::Surface surface(build_mesh(std::move(soup)).mesh, {});
    const Mesh& mesh = surface.mesh();
    const Halfedge h = mesh.find_halfedge(Vertex(12), Vertex(13));
    EXPECT_TRUE(fan.gather(surface, h, 64));
    const glm::vec3& p = mesh.position(Vertex(13));
    fan.check_shape(surface, p);
    appraisal = simplify::appraise(surface, h, fan, {1.0F, 1.0F, p});
  }

  simplify::Fan fan;
  simplify::Appraisal appraisal;
};

TEST(Appraisal, RetreatCountsAsLeftBehind) {
  const RemovedTip tip;
  EXPECT_NEAR(tip.appraisal.retreat, 3.0F, 0.01F);
  EXPECT_NEAR(tip.appraisal.left_behind, 1.0F + 81.0F, 1.0F) << "the fourth power of the distance";
}

TEST(Appraisal, TurnedFacesDoNotCountAsLeftBehind) {
  const RemovedTip tip;
  const float turned = tip.fan.turned_area() * tip.fan.turned_area();
  EXPECT_FLOAT_EQ(tip.appraisal.cost, tip.appraisal.left_behind + turned);
}

}  // namespace
}  // namespace mesher::test
