#include "app/ui/layout.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace mesher::app {
namespace {

bool overlap(const Rect& a, const Rect& b) {
  return !a.is_empty() && !b.is_empty() && a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

double area(const Rect& r) {
  return r.is_empty() ? 0.0 : double(r.width()) * double(r.height());
}

std::array<Rect, 8> parts_of(const Layout& all) {
  return {all.menu, all.rail, all.facts, all.panel, all.detail, all.status, all.model, all.tabs};
}

TEST(Layout, PartsFillTheWindowWithoutOverlap) {
  for (const glm::vec2 size : {glm::vec2(64, 64),
                               {300, 300},
                               {500, 500},
                               {599, 900},
                               {600, 600},
                               {800, 600},
                               {899, 300},
                               {900, 260},
                               {1400, 900},
                               {3840, 2160},
                               {1600, 80},
                               {80, 1600}}) {
    for (const float scale : {1.0F, 1.25F, 2.0F, 3.0F}) {
      for (const int shown : {0, 1, 2, 3}) {
        const bool shows_docks = (shown & 1) != 0;
        const bool shows_tabs = (shown & 2) != 0;
        SCOPED_TRACE(testing::Message()
                     << size.x << " x " << size.y << " at " << scale
                     << (shows_docks ? " with docks" : "") << (shows_tabs ? " with tabs" : ""));
        const Layout all = layout_of(size, scale, shows_docks, shows_tabs);
        const bool lies_over = all.width == Layout::Width::small;
        double sum = 0.0;
        for (const Rect& part : parts_of(all)) {
          if (part.is_empty()) continue;
          EXPECT_GE(part.x0, 0.0F);
          EXPECT_GE(part.y0, 0.0F);
          EXPECT_LE(part.x1, size.x);
          EXPECT_LE(part.y1, size.y);
          if (&part == &parts_of(all)[3] && lies_over) continue;
          sum += area(part);
        }
        if (lies_over) sum = area(all.rail) + area(all.detail) + area(all.model);
        EXPECT_NEAR(sum, double(size.x) * double(size.y), 1.0);
        const auto parts = parts_of(all);
        for (std::size_t i = 0; i < parts.size(); ++i) {
          for (std::size_t j = i + 1; j < parts.size(); ++j) {
            const bool is_panel_over_model = lies_over && i == 3;
            EXPECT_EQ(overlap(parts[i], parts[j]) && !(is_panel_over_model && j == 6), false)
                << i << " and " << j;
          }
        }
      }
    }
  }
}

TEST(Layout, SmallWindowsKeepRailAndBarOnly) {
  const Layout all = layout_of({300, 300}, 1.0F, false, false);
  EXPECT_EQ(all.width, Layout::Width::small);
  EXPECT_TRUE(all.menu.is_empty());
  EXPECT_TRUE(all.status.is_empty());
  EXPECT_TRUE(all.panel.is_empty());
  EXPECT_GT(area(all.model), 0.65 * 300 * 300);
  const Layout open = layout_of({300, 300}, 1.0F, true, false);
  EXPECT_EQ(area(open.model), area(all.model)) << "the panel lies over the model";
  EXPECT_FALSE(open.panel.is_empty());
  EXPECT_FALSE(overlap(open.panel, open.rail)) << "the rail closes the panel";
}

TEST(Layout, ScaleCountsInPoints) {
  EXPECT_TRUE(fits_docks({900, 600}, 1.0F));
  EXPECT_FALSE(fits_docks({900, 600}, 1.1F));
  EXPECT_TRUE(fits_docks({1800, 1200}, 2.0F));
  const Layout once = layout_of({1000, 700}, 1.0F, true, false);
  const Layout twice = layout_of({2000, 1400}, 2.0F, true, false);
  EXPECT_EQ(2.0F * once.model.x0, twice.model.x0);
  EXPECT_EQ(2.0F * once.model.y1, twice.model.y1);
}

TEST(Layout, InsetsLeaveTheModelsRectangle) {
  const glm::vec2 size(1000, 700);
  const Layout all = layout_of(size, 1.0F, true, false);
  const Insets insets = insets_of(all, size, {2.0F, 2.0F});
  EXPECT_EQ(insets.left, 2.0 * all.model.x0);
  EXPECT_EQ(insets.top, 2.0 * all.model.y0);
  EXPECT_EQ(insets.right, 2.0 * (size.x - all.model.x1));
  EXPECT_EQ(insets.bottom, 2.0 * (size.y - all.model.y1));
}

}  // namespace
}  // namespace mesher::app
