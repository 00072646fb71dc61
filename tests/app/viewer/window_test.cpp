#include "app/viewer/window.h"

#include <gtest/gtest.h>

namespace mesher::app {
namespace {

TEST(Window, DefaultSizeIsInPoints) {
  EXPECT_EQ(default_window_size(1.0F, {1920, 1080}), glm::ivec2(1280, 800));
  EXPECT_EQ(default_window_size(2.0F, {3840, 2160}), glm::ivec2(2560, 1600));
  EXPECT_EQ(default_window_size(1.25F, {0, 0}), glm::ivec2(1600, 1000)) << "no monitor is known";
  EXPECT_EQ(default_window_size(0.5F, {0, 0}), glm::ivec2(640, 400));
}

TEST(Window, DefaultSizeFitsTheScreen) {
  EXPECT_EQ(default_window_size(2.0F, {1920, 1053}), glm::ivec2(1920, 1053));
  EXPECT_EQ(default_window_size(1.0F, {1024, 1200}), glm::ivec2(1024, 800));
  EXPECT_EQ(default_window_size(1.0F, {2000, 700}), glm::ivec2(1280, 700));
}

}  // namespace
}  // namespace mesher::app
