// Needs a display; ctest runs it under Xvfb.

#include "engine/gpu/presenter.h"

#include <gtest/gtest.h>

#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include <memory>
#include <vector>

#include "engine/gpu/device_image.h"
#include "engine/gpu/result.h"

namespace mesher::gpu {
namespace {

class PresenterTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(glfwInit()) << "no display: run under xvfb-run";
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(320, 240, "presenter test", nullptr, nullptr);
    ASSERT_NE(window_, nullptr);
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    instance_ = std::make_unique<Instance>(
        InstanceOptions{.extensions = {names, names + count}, .validation = true});
    VkSurfaceKHR handle = VK_NULL_HANDLE;
    check(glfwCreateWindowSurface(instance_->handle(), window_, nullptr, &handle),
          "glfwCreateWindowSurface");
    surface_ = std::make_unique<Surface>(*instance_, handle);
    device_ = std::make_unique<Device>(*instance_, DeviceOptions{.surface = handle});
    presenter_ = std::make_unique<Presenter>(*device_, handle);
  }

  void TearDown() override {
    presenter_.reset();
    device_.reset();
    surface_.reset();
    if (instance_) {
      for (const std::string& message : instance_->messages().list())
        ADD_FAILURE() << message;
    }
    instance_.reset();
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  VkExtent2D window_size() {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  }

  bool present() {
    glfwPollEvents();
    const std::optional<Frame> frame = presenter_->begin(window_size());
    if (!frame) return false;
    transition(frame->commands, frame->image, kUndefined, kTransferTarget);
    const VkClearColorValue color{{0.1F, 0.5F, 0.2F, 1.0F}};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(frame->commands, frame->image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         &color, 1, &all);
    transition(frame->commands, frame->image, kTransferTarget, kColorAttachment);
    extent_ = frame->extent;
    presenter_->submit(*frame);
    presenter_->present(*frame);
    return true;
  }

  GLFWwindow* window_ = nullptr;
  std::unique_ptr<Instance> instance_;
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<Presenter> presenter_;
  VkExtent2D extent_{};
};

TEST_F(PresenterTest, PresentsManyFramesFromOneSwapchain) {
  for (int i = 0; i < 20; ++i)
    EXPECT_TRUE(present());
  EXPECT_EQ(presenter_->generation(), 1U);
  EXPECT_GE(presenter_->image_count(), 2U);
  EXPECT_TRUE(presenter_->format() == VK_FORMAT_B8G8R8A8_UNORM ||
              presenter_->format() == VK_FORMAT_R8G8B8A8_UNORM);
}

TEST_F(PresenterTest, FollowsTheWindowSize) {
  ASSERT_TRUE(present());
  for (const int width : {400, 200, 333, 50}) {
    glfwSetWindowSize(window_, width, 100 + width / 3);
    bool has_size = false;
    for (int i = 0; i < 50 && !has_size; ++i) {
      glfwWaitEventsTimeout(0.02);
      present();
      has_size = extent_.width == static_cast<std::uint32_t>(width);
    }
    EXPECT_TRUE(has_size) << width;
    const std::uint64_t generation = presenter_->generation();
    for (int i = 0; i < 5; ++i)
      EXPECT_TRUE(present());
    EXPECT_LE(presenter_->generation(), generation + 1)
        << "the swapchain stays unchanged until the next resize";
  }
}

TEST_F(PresenterTest, BeginReturnsNothingWhileMinimized) {
  ASSERT_TRUE(present());
  const std::uint64_t generation = presenter_->generation();
  EXPECT_FALSE(presenter_->begin({0, 0}));
  EXPECT_FALSE(presenter_->begin({0, 240}));
  EXPECT_EQ(presenter_->generation(), generation);
  EXPECT_TRUE(present());
}

}  // namespace
}  // namespace mesher::gpu
