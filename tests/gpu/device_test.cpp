#include "engine/gpu/device.h"

#include <cstdlib>
#include <vector>

#include "engine/core/error.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/result.h"
#include "tests/support/gpu_test.h"

namespace mesher::gpu {
namespace {

using DeviceTest = test::GpuTest;

template <class Function>
std::string message_of(Function&& function) {
  try {
    function();
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::machine_lacks);
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Result, NamesMatchTheStandard) {
  EXPECT_EQ(result_name(VK_ERROR_OUT_OF_DEVICE_MEMORY), "VK_ERROR_OUT_OF_DEVICE_MEMORY");
  EXPECT_EQ(result_name(static_cast<VkResult>(-12345)), "VkResult -12345");
  EXPECT_NO_THROW(check(VK_SUCCESS, "vkNothing"));
  EXPECT_EQ(message_of([] { check(VK_ERROR_FEATURE_NOT_PRESENT, "vkCreateDevice"); }),
            "vkCreateDevice: VK_ERROR_FEATURE_NOT_PRESENT");
  EXPECT_EQ(message_of([] { check(VK_ERROR_DEVICE_LOST, "vkQueueSubmit2"); }),
            "the GPU stopped working (vkQueueSubmit2: VK_ERROR_DEVICE_LOST)");
  EXPECT_EQ(message_of([] { check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkAllocateMemory"); }),
            "out of GPU memory (vkAllocateMemory: VK_ERROR_OUT_OF_DEVICE_MEMORY)");
  EXPECT_THROW(check(VK_ERROR_DEVICE_LOST, ""), LostError);
  EXPECT_THROW(check(VK_ERROR_SURFACE_LOST_KHR, ""), LostError);
  EXPECT_THROW(check(VK_ERROR_OUT_OF_HOST_MEMORY, ""), OutOfMemoryError);
}

TEST(Instance, MissingDriverIsReportedInOneLine) {
  ASSERT_EQ(setenv("VK_DRIVER_FILES", "/nonexistent/driver.json", 1), 0);
  ASSERT_EQ(setenv("VK_ICD_FILENAMES", "/nonexistent/driver.json", 1), 0);
  const std::string message = message_of([] {
    const Instance instance;
    const Device device(instance);
  });
  unsetenv("VK_DRIVER_FILES");
  unsetenv("VK_ICD_FILENAMES");
  EXPECT_TRUE(contains(message, "no Vulkan")) << message;
  EXPECT_FALSE(contains(message, "\n"));
}

TEST(Instance, MissingExtensionIsNamed) {
  const std::string message =
      message_of([] { const Instance instance({.extensions = {"VK_KHR_not_there"}}); });
  EXPECT_TRUE(contains(message, "VK_ERROR_EXTENSION_NOT_PRESENT")) << message;
}

TEST_F(DeviceTest, ListsDevicesAndSelectsTheBestByDefault) {
  const std::vector<DeviceDescription> devices = instance().devices();
  ASSERT_FALSE(devices.empty());
  bool is_listed = false;
  for (const DeviceDescription& description : devices) {
    EXPECT_FALSE(description.name.empty());
    EXPECT_FALSE(description.kind.empty());
    is_listed = is_listed || (description.is_usable && description.name == device().name());
  }
  EXPECT_TRUE(is_listed);
}

TEST_F(DeviceTest, SelectsByIndexAndByPartOfTheNameInAnyCase) {
  const std::string name = instance().devices().front().name;
  EXPECT_EQ(Device(instance(), {.select = "0"}).name(), name);
  std::string part = name.substr(0, 4);
  for (char& c : part)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_EQ(Device(instance(), {.select = part}).name(), name);
}

TEST_F(DeviceTest, RejectsUnknownSelectionAndListsDevices) {
  const std::string name = instance().devices().front().name;
  for (const std::string select : {"no such thing", "99"}) {
    const std::string message =
        message_of([&] { const Device other(instance(), {.select = select}); });
    EXPECT_TRUE(contains(message, select)) << message;
    EXPECT_TRUE(contains(message, name)) << message;
  }
}

TEST_F(DeviceTest, DeferredDestructionWaitsForSubmissions) {
  bool is_destroyed = false;
  device().run_once([&](VkCommandBuffer) {
    device().retire([&](VkDevice) { is_destroyed = true; });
    EXPECT_FALSE(is_destroyed);
  });
  EXPECT_TRUE(is_destroyed);
  EXPECT_EQ(device().submitted(), 1U);
}

TEST_F(DeviceTest, ExceptionDuringRecordingLeavesTheDeviceUsable) {
  EXPECT_THROW(device().run_once([](VkCommandBuffer) { throw DeviceError("no"); }), DeviceError);
  EXPECT_NO_THROW(device().run_once([](VkCommandBuffer) {}));
}

TEST_F(DeviceTest, SupportsFourSamplesOrFallsBackToOne) {
  EXPECT_EQ(device().supported_samples(4), VK_SAMPLE_COUNT_4_BIT);
  EXPECT_EQ(device().supported_samples(1), VK_SAMPLE_COUNT_1_BIT);
  EXPECT_EQ(device().supported_samples(3), VK_SAMPLE_COUNT_1_BIT);
}

// The next two tests verify that the validation layers detect errors.

TEST_F(DeviceTest, ValidationDetectsMisuse) {
  const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                .pNext = nullptr,
                                .flags = 0,
                                .size = 0,  // invalid
                                .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                .queueFamilyIndexCount = 0,
                                .pQueueFamilyIndices = nullptr};
  VkBuffer buffer = VK_NULL_HANDLE;
  if (vkCreateBuffer(device().handle(), &info, nullptr, &buffer) == VK_SUCCESS) {
    vkDestroyBuffer(device().handle(), buffer, nullptr);
  }
  ASSERT_GE(instance().messages().count(), 1U);
  EXPECT_TRUE(contains(instance().messages().list().front(), "VUID-VkBufferCreateInfo-size-00912"));
  instance().messages().clear();
}

TEST_F(DeviceTest, ValidationDetectsMissingBarrier) {
  const Buffer a(device(), 64, 0, MemoryIntent::fixed);
  const Buffer b(device(), 64, 0, MemoryIntent::fixed);
  device().run_once([&](VkCommandBuffer commands) {
    const VkBufferCopy region{0, 0, 64};
    vkCmdCopyBuffer(commands, a.handle(), b.handle(), 1, &region);
    vkCmdCopyBuffer(commands, b.handle(), a.handle(), 1, &region);
  });
  ASSERT_GE(instance().messages().count(), 1U);
  EXPECT_TRUE(contains(instance().messages().list().front(), "SYNC-HAZARD"));
  instance().messages().clear();
}

}  // namespace
}  // namespace mesher::gpu
