#include "app/document/playback.h"

#include <gtest/gtest.h>

#include "app/document/document.h"

namespace mesher::app {
namespace {

Document animated() {
  scene::Scene scene;
  scene.nodes.resize(1);
  scene.animations = {{.name = "slide",
                       .duration_s = 2.0,
                       .channels = {{.node = 0, .times = {0, 2}, .values = {0, 0, 0, 8, 0, 0}}}}};
  Document document;
  document.model.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return document;
}

double x_of(const Document& document) {
  return shown_poses(document).at(0).translation->x;
}

TEST(Playback, PlaysTheFirstAnimationAndBeginsAgainAfterItsEnd) {
  Document document = animated();
  EXPECT_TRUE(shown_poses(document).empty());
  EXPECT_FALSE(advance_animation(document, 1.0));
  play_animation(document);
  EXPECT_TRUE(advance_animation(document, 0.5));
  EXPECT_EQ(x_of(document), 2.0);
  advance_animation(document, 1.75);
  EXPECT_EQ(x_of(document), 1.0);
  play_animation(document);
  EXPECT_FALSE(advance_animation(document, 1.0));
  EXPECT_EQ(x_of(document), 1.0) << "a pause keeps the moment";
  choose_animation(document, kNone);
  EXPECT_TRUE(shown_poses(document).empty());
}

TEST(Playback, ModelsWithoutAnimationsHaveNothingToPlay) {
  EXPECT_FALSE(has_animations(Document()));
  EXPECT_TRUE(has_animations(animated()));
}

}  // namespace
}  // namespace mesher::app
