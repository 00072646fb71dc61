#include "app/ui/overlay.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>

#include "app/document/session.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"
#include "engine/gpu/device_image.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

/// Glyphs that are elsewhere in the atlas may differ by a rounding error.
int largest_difference(const Image& a, const Image& b) {
  int most = a.rgba.size() == b.rgba.size() ? 0 : 256;
  for (std::size_t i = 0; i < std::min(a.rgba.size(), b.rgba.size()); ++i)
    most = std::max(most, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
  return most;
}

class OverlayTest : public test::GpuTest {
 protected:
  static constexpr VkExtent2D kExtent{1600, 1000};
  static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;

  OverlayTest() {
    Model model;
    model.name = "cube.obj";
    model.mesh = build_mesh(test::cube()).mesh;
    show_model(session_, std::move(model), "cube.obj");
    session_.shows_info = true;
    session_.view.window = {kExtent.width, kExtent.height};
  }
  /// Draws until the layout has settled.
  void draw(Overlay& overlay) {
    for (int frame = 0; frame < 3; ++frame) {
      overlay.begin(session_.view.window);
      panels_.draw(session_, {.window = session_.view.window, .device = ""});
      overlay.end();
    }
  }
  /// The pixels of the panels over black.
  Image picture(Overlay& overlay) {
    const gpu::DeviceImage image(
        device(), {.format = kFormat,
                   .extent = kExtent,
                   .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                            VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    device().run_once([&](VkCommandBuffer commands) {
      gpu::transition(commands, image.handle(), gpu::kUndefined, gpu::kTransferTarget);
      const VkClearColorValue black{};
      const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
      vkCmdClearColorImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black,
                           1, &range);
      gpu::transition(commands, image.handle(), gpu::kTransferTarget, gpu::kColorAttachment);
      overlay.draw(commands, image.view(), kExtent);
    });
    overlay.forget_images();
    return gpu::read_image(device(), image, gpu::kColorAttachment);
  }
  float height_of(const std::string& widget) const {
    const glm::vec4 area = panels_.widgets().at(widget);
    return area.w - area.y;
  }

  Session session_;
  Panels panels_;
};

TEST_F(OverlayTest, ScaleChangesWhileItIsShown) {
  Overlay overlay(instance(), device(), kFormat, nullptr, 1.0F);
  draw(overlay);
  const Image once = picture(overlay);
  const float height = height_of("detail/slider");
  const float padding = ImGui::GetStyle().WindowPadding.x;
  overlay.set_scale(2.0F);
  draw(overlay);
  EXPECT_FLOAT_EQ(ImGui::GetFontSize(), 2.0F * kFontPoints);
  EXPECT_FLOAT_EQ(ImGui::GetStyle().WindowPadding.x, 2.0F * padding);
  EXPECT_NEAR(height_of("detail/slider"), 2.0F * height, 2.0F);
  EXPECT_GT(largest_difference(picture(overlay), once), 100);
  overlay.set_scale(1.0F);
  draw(overlay);
  EXPECT_LE(largest_difference(picture(overlay), once), 2) << "nothing of the other scale is left";
}

}  // namespace
}  // namespace mesher::app
