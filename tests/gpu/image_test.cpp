#include "engine/core/error.h"
#include "engine/gpu/device_image.h"
#include "tests/support/gpu_test.h"

namespace mesher::gpu {
namespace {

using ImageTest = test::GpuTest;

DeviceImage cleared(Device& device, VkFormat format) {
  DeviceImage image(device,
                    {.format = format,
                     .extent = {5, 3},
                     .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                              VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT});
  device.run_once([&](VkCommandBuffer commands) {
    transition(commands, image.handle(), kUndefined, kTransferTarget);
    const VkClearColorValue color{{1.0F, 0.2F, 0.0F, 0.6F}};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &color, 1,
                         &all);
    transition(commands, image.handle(), kTransferTarget, kColorAttachment);
  });
  return image;
}

TEST_F(ImageTest, ReadsAsRgbaForAnyByteOrder) {
  for (const VkFormat format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM}) {
    const DeviceImage image = cleared(device(), format);
    const Image read = read_image(device(), image, kColorAttachment);
    EXPECT_EQ(read.width, 5U);
    EXPECT_EQ(read.height, 3U);
    ASSERT_EQ(read.rgba.size(), 60U);
    for (std::uint32_t y = 0; y < 3; ++y) {
      for (std::uint32_t x = 0; x < 5; ++x) {
        const std::uint8_t* p = read.pixel(x, y);
        EXPECT_EQ(p[0], 255);
        EXPECT_EQ(p[1], 51);
        EXPECT_EQ(p[2], 0);
        EXPECT_EQ(p[3], 153);
      }
    }
    // Reading does not change the image: a second read returns the same.
    EXPECT_EQ(read_image(device(), image, kColorAttachment).rgba, read.rgba);
  }
}

TEST_F(ImageTest, RejectsImpossibleSizes) {
  EXPECT_THROW(DeviceImage(device(), {.extent = {0, 5}}), DeviceError);
  EXPECT_THROW(DeviceImage(device(), {.extent = {1U << 30, 5}}), DeviceError);
  // Within the limits on width and height, but larger than the memory.
  const std::uint32_t widest = device().properties().limits.maxImageDimension2D;
  EXPECT_THROW(
      DeviceImage(device(), {.extent = {widest, widest}, .samples = VK_SAMPLE_COUNT_4_BIT}),
      DeviceError);
}

}  // namespace
}  // namespace mesher::gpu
