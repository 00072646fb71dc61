#include "app/input/gestures.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/document/session.h"
#include "app/edit/crease_edits.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

class GesturesTest : public testing::Test {
 protected:
  GesturesTest() {
    Model model;
    model.mesh = build_mesh(test::cube()).mesh;
    session_.view.window = {400, 400};
    show_model(session_, std::move(model), "cube.obj");
    before_ = session_.view.camera;
  }

  void drag(MouseButton button, bool shift, glm::dvec2 from, glm::dvec2 to) {
    gestures_.press(button, {.shift = shift}, from, 0.0);
    gestures_.move(to);
    gestures_.release();
  }

  Session session_;
  Gestures gestures_{session_.document, session_.view};
  render::Camera before_;
};

TEST_F(GesturesTest, LeftDragOrbits) {
  drag(MouseButton::left, false, {100, 100}, {160, 130});
  EXPECT_NE(session_.view.camera.yaw_rad(), before_.yaw_rad());
  EXPECT_NE(session_.view.camera.pitch_rad(), before_.pitch_rad());
  EXPECT_EQ(session_.view.camera.pivot(), before_.pivot());
  EXPECT_EQ(session_.view.camera.distance(), before_.distance());
}

TEST_F(GesturesTest, ShiftDragAndRightDragPanEqually) {
  drag(MouseButton::left, true, {100, 100}, {160, 130});
  const glm::dvec3 pivot = session_.view.camera.pivot();
  EXPECT_NE(pivot, before_.pivot());
  EXPECT_EQ(session_.view.camera.yaw_rad(), before_.yaw_rad());
  session_.view.camera = before_;
  drag(MouseButton::right, false, {100, 100}, {160, 130});
  EXPECT_EQ(session_.view.camera.pivot(), pivot);
  session_.view.camera = before_;
  drag(MouseButton::middle, false, {100, 100}, {160, 130});
  EXPECT_EQ(session_.view.camera.pivot(), pivot);
}

TEST_F(GesturesTest, MoveWithoutButtonDoesNothing) {
  EXPECT_FALSE(gestures_.move({300, 300}));
  EXPECT_TRUE(session_.view.camera == before_);
  drag(MouseButton::left, false, {100, 100}, {100, 100});
  EXPECT_TRUE(session_.view.camera == before_);
}

TEST_F(GesturesTest, WheelZoomsTowardCursor) {
  gestures_.scroll(2.0, {300, 100});
  EXPECT_LT(session_.view.camera.distance(), before_.distance());
  EXPECT_GT(glm::dot(session_.view.camera.pivot() - before_.pivot(), before_.right()), 0.0);
  EXPECT_GT(glm::dot(session_.view.camera.pivot() - before_.pivot(), before_.up()), 0.0);
  gestures_.scroll(-2.0, {300, 100});
  EXPECT_NEAR(session_.view.camera.distance(), before_.distance(), 1e-12);
  EXPECT_NEAR(glm::distance(session_.view.camera.pivot(), before_.pivot()), 0.0, 1e-12);
}

TEST_F(GesturesTest, DoubleClickRecentersOnSurface) {
  session_.view.camera.set_view(render::View::front);
  gestures_.press(MouseButton::left, {}, {230, 180}, 1.0);
  gestures_.release();
  gestures_.press(MouseButton::left, {}, {231, 180}, 1.2);
  gestures_.release();
  EXPECT_NEAR(session_.view.camera.pivot().z, 0.5, 1e-9);
  EXPECT_GT(session_.view.camera.pivot().x, 0.0);
}

TEST_F(GesturesTest, SlowOrDistantClicksAreNoDoubleClick) {
  gestures_.press(MouseButton::left, {}, {230, 180}, 1.0);
  gestures_.release();
  gestures_.press(MouseButton::left, {}, {230, 180}, 1.5);
  gestures_.release();
  gestures_.press(MouseButton::left, {}, {200, 180}, 1.6);
  gestures_.release();
  EXPECT_TRUE(session_.view.camera == before_);
}

TEST_F(GesturesTest, DoubleClickBesideModelChangesNothing) {
  gestures_.press(MouseButton::left, {}, {2, 2}, 1.0);
  gestures_.release();
  gestures_.press(MouseButton::left, {}, {2, 2}, 1.1);
  gestures_.release();
  EXPECT_TRUE(session_.view.camera == before_);
}

/// Shows the front of the cube; its diagonal runs through the middle of the window.
class CreaseGesturesTest : public GesturesTest {
 protected:
  CreaseGesturesTest() {
    session_.view.camera.set_view(render::View::front);
    set_crease_mode(session_.document, true);
    before_ = session_.view.camera;
  }
  void click(Modifiers modifiers, glm::dvec2 at, double time) {
    gestures_.press(MouseButton::left, modifiers, at, time);
    gestures_.release();
  }
  std::size_t selected() const { return session_.document.creases.selected.size(); }

  static constexpr glm::dvec2 kMiddle{200, 200};
  static constexpr glm::dvec2 kOff{250, 200};
};

TEST_F(CreaseGesturesTest, ClickSelectsEdgeOnRelease) {
  gestures_.press(MouseButton::left, {}, kMiddle, 1.0);
  EXPECT_EQ(selected(), 0U);
  gestures_.move(kMiddle + glm::dvec2(2, 1));  // the pointer may move a little
  gestures_.release();
  EXPECT_EQ(selected(), 1U);
  EXPECT_TRUE(session_.view.camera == before_);
  click({}, kOff, 2.0);
  EXPECT_EQ(selected(), 0U);
}

TEST_F(CreaseGesturesTest, DragOrbitsAndSelectsNothing) {
  drag(MouseButton::left, false, kMiddle, {260, 230});
  EXPECT_EQ(selected(), 0U);
  render::Camera expected = before_;
  expected.orbit({60, 30}, session_.view.window);
  EXPECT_TRUE(session_.view.camera == expected) << "the whole path counts";
  session_.view.camera = before_;
  drag(MouseButton::left, true, kMiddle, {260, 230});
  EXPECT_NE(session_.view.camera.pivot(), before_.pivot());
  // Moving away and back is also a drag.
  gestures_.press(MouseButton::left, {}, kMiddle, 5.0);
  gestures_.move(kMiddle + glm::dvec2(30, 0));
  gestures_.move(kMiddle);
  gestures_.release();
  EXPECT_EQ(selected(), 0U);
}

TEST_F(CreaseGesturesTest, CtrlClickTogglesAndOtherButtonsDoNotSelect) {
  click({}, kMiddle, 1.0);
  const glm::dvec2 top = session_.view.camera.places(session_.view.window).of({0.1, 0.5, 0.5});
  click({.control = true}, top + glm::dvec2(0, 2), 2.0);
  EXPECT_EQ(selected(), 2U);
  click({.control = true}, kMiddle, 3.0);
  EXPECT_EQ(selected(), 1U);
  gestures_.press(MouseButton::right, {}, kMiddle, 4.0);
  gestures_.release();
  EXPECT_EQ(selected(), 1U);
}

TEST_F(CreaseGesturesTest, DoubleClickSelectsChainAndKeepsCamera) {
  Model model;
  model.mesh = build_mesh(test::grid(6)).mesh;
  show_model(session_, std::move(model), "grid.obj");
  const render::Camera before = session_.view.camera;
  const glm::dvec2 at = session_.view.camera.places(session_.view.window).of({2.4, 3.0, 0.0});
  click({}, at, 1.0);
  EXPECT_EQ(selected(), 1U);
  click({}, at, 1.2);
  EXPECT_EQ(selected(), 6U);
  click({}, at, 2.0);
  EXPECT_EQ(selected(), 1U);
  click({.shift = true}, at, 3.0);
  EXPECT_EQ(selected(), 6U);
  EXPECT_TRUE(session_.view.camera == before);
}

}  // namespace
}  // namespace mesher::app
