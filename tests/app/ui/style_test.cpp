#include "app/ui/style.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mesher::app {
namespace {

/// The contrast of two sRGB colors, from 1 to 21, as WCAG 2.1 defines it.
double contrast(const glm::vec3& a, const glm::vec3& b) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const auto luminance = [&](const glm::vec3& c) {
    return 0.2126 * linear(c.x) + 0.7152 * linear(c.y) + 0.0722 * linear(c.z);
  };
  const auto [least, most] = std::minmax({luminance(a), luminance(b)});
  return (most + 0.05) / (least + 0.05);
}

TEST(Style, ContrastIsMeasuredAsDefined) {
  EXPECT_NEAR(contrast({0, 0, 0}, {1, 1, 1}), 21.0, 1e-6);
  EXPECT_NEAR(contrast({0x80 / 255.0F, 0x80 / 255.0F, 0x80 / 255.0F},
                       {0x2D / 255.0F, 0x30 / 255.0F, 0x34 / 255.0F}),
              3.4, 0.1);
}

TEST(Style, TextCanBeReadOnEveryGround) {
  for (const render::Background background :
       {render::Background::light, render::Background::dark}) {
    const Theme& t = theme(background);
    for (const glm::vec3& ground : {t.panel, t.field, t.button, t.hovered, t.active}) {
      EXPECT_GE(contrast(t.text, ground), 4.5);
      EXPECT_GE(contrast(t.faint, ground), 4.5);
    }
    for (const glm::vec3& text : {t.caution, t.problem, t.grab})
      EXPECT_GE(contrast(text, t.panel), 4.5);
    EXPECT_GE(contrast(t.grab, t.field), 3.0) << "WCAG 2.1, 1.4.11: parts of controls";
  }
}

}  // namespace
}  // namespace mesher::app
