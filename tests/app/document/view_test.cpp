#include "app/document/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace mesher::app {
namespace {

const Box kBox{{-1.0F, -2.0F, -3.0F}, {1.0F, 2.0F, 3.0F}};

View framed() {
  View view;
  set_default_view(view.camera);
  view.camera.frame(kBox, view.aspect());
  return view;
}

TEST(View, InsetsShrinkTheRectangleOfTheModel) {
  View view = framed();
  resize(view, kBox, {1000.0, 700.0}, {40.0, 30.0, 300.0, 80.0});
  EXPECT_EQ(view.corner(), glm::dvec2(40.0, 30.0));
  EXPECT_EQ(view.size(), glm::dvec2(660.0, 590.0));
  EXPECT_EQ(view.cursor({41.0, 32.0}).position, glm::dvec2(1.0, 2.0));
  EXPECT_EQ(view.cursor({41.0, 32.0}).window, view.size());
  resize(view, kBox, {10.0, 10.0}, {40.0, 30.0, 300.0, 80.0});
  EXPECT_EQ(view.size(), glm::dvec2(1.0, 1.0)) << "never empty";
}

TEST(View, FlatModelIsNotSeenFromItsEdge) {
  const auto share_of = [](const Box& box, const glm::dvec3& normal) {
    View view;
    set_default_view(view.camera, box);
    return std::abs(glm::dot(view.camera.forward(), normal));
  };
  EXPECT_GT(share_of({{-1, 0, -1}, {1, 0, 1}}, {0, 1, 0}), 0.6);
  EXPECT_GT(share_of({{-1, -0.45F, -1}, {1, 0.45F, 1}}, {0, 1, 0}), 0.6) << "as the hypersheet";
  EXPECT_GT(share_of({{0, -1, -1}, {0, 1, 1}}, {1, 0, 0}), 0.6);
  EXPECT_GT(share_of({{-1, -1, 0}, {1, 1, 0}}, {0, 0, 1}), 0.6);
  render::Camera usual;
  set_default_view(usual);
  View view;
  set_default_view(view.camera, kBox);
  EXPECT_EQ(view.camera, usual);
}

TEST(View, FramedModelStaysFramed) {
  View view = framed();
  for (const glm::dvec2 window : {glm::dvec2(300.0, 900.0), {2000.0, 500.0}, {800.0, 600.0}}) {
    resize(view, kBox, window, {40.0, 30.0, 0.0, 60.0});
    render::Camera expected = view.camera;
    expected.frame(kBox, view.aspect());
    EXPECT_EQ(view.camera, expected);
  }
}

TEST(View, ModelKeepsItsShareOfTheSmallerSide) {
  View view = framed();
  view.camera.zoom(1.7);
  const double distance = view.camera.distance();
  resize(view, kBox, {1600.0, 600.0}, {});
  EXPECT_EQ(view.camera.distance(), distance) << "both are wide: the height is the smaller side";
  resize(view, kBox, {300.0, 600.0}, {});
  EXPECT_NEAR(view.camera.distance(), 2.0 * distance, 1e-12);
  resize(view, kBox, {800.0, 600.0}, {});
  EXPECT_NEAR(view.camera.distance(), distance, 1e-12);
}

}  // namespace
}  // namespace mesher::app
