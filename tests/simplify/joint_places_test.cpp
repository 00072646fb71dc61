#include "engine/simplify/joint_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/mesh/wedges.h"
#include "engine/simplify/simplify_model.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using simplify::joint_places;

/// A flat sheet, 12 wide, whose left part follows joint 3 and whose right part follows joint 4.
/// Between `first` and `last` the weights change evenly.
struct Skinned {
  Skinned(float first, float last, const glm::vec3& offset = glm::vec3(0.0F))
      : mesh(built(grid(12)).mesh) {
    std::vector<AttributeLayer> layers;
    layers.emplace_back(AttributeType{AttributeKind::joints, "JOINTS_0", 4, ComponentType::u8},
                        mesh.halfedge_count());
    layers.emplace_back(AttributeType{AttributeKind::weights, "WEIGHTS_0", 4, ComponentType::f32},
                        mesh.halfedge_count());
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      const float x = mesh.position(mesh.origin(Halfedge(h))).x;
      const double right = std::clamp((x - first) / (last - first), 0.0F, 1.0F);
      store(layers[0], h, {3, 4, 0, 0});
      store(layers[1], h, {1.0 - right, right, 0, 0});
    }
    set_corner_layers(mesh, attributes, std::move(layers));
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
      mesh.set_position(Vertex(v), mesh.position(Vertex(v)) + offset);
  }

  Mesh mesh;
  Attributes attributes;
};

/// Returns how much a point of a model follows joint 4.
double right_share(const Attributes& attributes, std::size_t wedge) {
  double share = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    if (load(attributes.layers[0], wedge)[c] == 4.0) share += load(attributes.layers[1], wedge)[c];
  }
  return share;
}

TEST(JointPlaces, AreTheMiddlesOfWhatFollowsTheJoints) {
  const Skinned sheet(5.5F, 6.5F);
  const auto places = joint_places(sheet.mesh, sheet.attributes);
  ASSERT_EQ(places.size(), sheet.mesh.vertex_count());
  for (std::uint32_t v = 0; v < sheet.mesh.vertex_count(); ++v) {
    const float x = sheet.mesh.position(Vertex(v)).x;
    if (x == 6.0F) {
      EXPECT_NEAR(places[v].x, 0.0, 1e-9) << "half of each";
    } else {
      // Columns 0 to 5, and half of column 6.
      const double middle = 6.0 - (0 + 1 + 2 + 3 + 4 + 5 + 0.5 * 6) / 6.5;
      EXPECT_NEAR(places[v].x, x < 6.0F ? -middle : middle, 1e-9);
    }
    EXPECT_NEAR(places[v].y, 0.0, 1e-9);
  }
}

TEST(JointPlaces, DoNotDependOnWhereTheModelIs) {
  const Skinned here(4.0F, 8.0F);
  const Skinned there(4.0F, 8.0F, glm::vec3(1 << 20, 0, 0));
  const auto places = joint_places(here.mesh, here.attributes);
  const auto moved = joint_places(there.mesh, there.attributes);
  for (std::size_t w = 0; w < places.size(); ++w)
    EXPECT_NEAR(places[w].x, moved[w].x, 1e-6);
}

TEST(JointPlaces, NoJointsNoPlaces) {
  const Skinned sheet(4.0F, 8.0F);
  EXPECT_TRUE(joint_places(sheet.mesh, {}).empty());
}

TEST(JointPlaces, WeightsOfAFlatSheetSurvive) {
  const Skinned sheet(5.0F, 7.0F);
  // The largest difference between the weights at the middle of an edge and those of the input.
  const auto worst = [&](float weight) {
    const simplify::SimplifiedModel model = simplify::simplify_model(
        Mesh(sheet.mesh), sheet.attributes, {.target_faces = 12, .weight_joint = weight});
    const Mesh& mesh = model.simplified.mesh;
    EXPECT_LE(mesh.face_count(), 12U);
    double most = 0.0;
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
      const Halfedge h(i);
      const auto share = [&](Halfedge corner) {
        return right_share(model.attributes,
                           model.attributes.wedge(mesh.origins(), corner).index());
      };
      const double x =
          0.5 * double{mesh.position(mesh.origin(h)).x + mesh.position(mesh.target(h)).x};
      const double exact = std::clamp((x - 5.0) / 2.0, 0.0, 1.0);
      most = std::max(most, std::abs(0.5 * (share(h) + share(Mesh::next(h))) - exact));
    }
    return most;
  };
  EXPECT_LT(worst(0.05F), 0.02);
  EXPECT_GT(worst(0.0F), 0.2) << "nothing else tells the flat sheet where to keep vertices";
}

}  // namespace
}  // namespace mesher::test
