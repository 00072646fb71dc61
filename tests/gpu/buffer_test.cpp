#include "engine/gpu/buffer.h"

#include <array>
#include <cstring>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "tests/support/gpu_test.h"

namespace mesher::gpu {
namespace {

using BufferTest = test::GpuTest;

std::vector<std::byte> counting(std::size_t n, unsigned start = 0) {
  std::vector<std::byte> bytes(n);
  for (std::size_t i = 0; i < n; ++i)
    bytes[i] = static_cast<std::byte>((i + start) % 251);
  return bytes;
}

TEST_F(BufferTest, DownloadReturnsTheUploadedBytes) {
  const std::vector<std::byte> bytes = counting(1000);
  Buffer buffer(device(), bytes.size(), 0, MemoryIntent::fixed);
  EXPECT_NE(buffer.address(), 0U);
  upload(device(), buffer, bytes);
  EXPECT_EQ(download(device(), buffer, bytes.size()), bytes);
}

TEST_F(BufferTest, UploadsOnlyTheGivenRangesDirectlyAndByStaging) {
  using Upload = void (*)(Device&, Buffer&, std::span<const std::byte>, std::span<const ByteRange>);
  for (const Upload upload_ranges : {static_cast<Upload>(upload), upload_by_staging}) {
    std::vector<std::byte> expected = counting(1000);
    Buffer buffer(device(), expected.size(), 0, MemoryIntent::fixed);
    upload(device(), buffer, expected);
    const std::vector<std::byte> changed = counting(1000, 100);
    constexpr std::array<ByteRange, 4> kRanges{{{0, 1}, {50, 50}, {100, 300}, {999, 1000}}};
    upload_ranges(device(), buffer, changed, kRanges);
    for (const ByteRange range : kRanges) {
      std::memcpy(&expected[range.begin], &changed[range.begin], range.size());
    }
    EXPECT_EQ(download(device(), buffer, expected.size()), expected);
    upload_ranges(device(), buffer, changed, {});
    EXPECT_EQ(download(device(), buffer, expected.size()), expected);
  }
}

TEST_F(BufferTest, ZeroBytesGiveANullBuffer) {
  Buffer buffer(device(), 0, 0, MemoryIntent::fixed);
  EXPECT_FALSE(buffer);
  upload(device(), buffer, {});
  EXPECT_TRUE(download(device(), buffer, 0).empty());
}

TEST_F(BufferTest, OversizedRequestFailsAndNamesBothSizes) {
  const std::uint64_t limit = device().max_buffer_bytes();
  try {
    const Buffer buffer(device(), limit + 1, 0, MemoryIntent::fixed);
    FAIL() << "the buffer was created";
  } catch (const DeviceError& error) {
    const std::string expected =
        "a buffer of " + bytes_text(limit + 1) + ", and the limit is " + bytes_text(limit);
    EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
  }
}

TEST_F(BufferTest, MoveLeavesTheSourceEmpty) {
  Buffer a(device(), 16, 0, MemoryIntent::dynamic);
  const VkBuffer handle = a.handle();
  Buffer b = std::move(a);
  EXPECT_EQ(b.handle(), handle);
  b = Buffer();
  EXPECT_FALSE(b);
}

}  // namespace
}  // namespace mesher::gpu
