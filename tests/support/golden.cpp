#include "tests/support/golden.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/io/png.h"

#if defined(__SSE__)
#include <cpuid.h>
#include <xmmintrin.h>
#endif

namespace mesher::test {
namespace {

const std::filesystem::path kGoldens = MESHER_SOURCE_DIR "/tests/golden";
const std::filesystem::path kCandidates = MESHER_GOLDEN_CANDIDATES;

std::string driver_of(const gpu::Device& device) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device.physical(), &properties);
  return device.name() + ", " + driver.driverInfo;
}

/// Returns the family and model of the processor, and a fingerprint of its approximate reciprocals,
/// or "none" if there are no such instructions. Llvmpipe divides and normalizes by reciprocals,
/// whose last bits differ by vendor, and compiles its shaders for the model.
std::string processor() {
#if defined(__SSE__)
  unsigned version = 0;
  unsigned unused = 0;
  __get_cpuid(1, &version, &unused, &unused, &unused);
  std::uint64_t hash = 14695981039346656037U;
  for (int i = 0; i < 4096; ++i) {
    const __m128 x = _mm_set_ss(1.0F + 3.0F * static_cast<float>(i) / 4096.0F);
    for (const __m128 y : {_mm_rcp_ss(x), _mm_rsqrt_ss(x)}) {
      hash = (hash ^ std::bit_cast<std::uint32_t>(_mm_cvtss_f32(y))) * 1099511628211U;
    }
  }
  constexpr unsigned kFamilyAndModel = 0x0FFF0FF0;
  return fmt::format("{:08x} {}", version & kFamilyAndModel, hash);
#else
  return "none";
#endif
}

Agreement expected_agreement(const gpu::Device& device) {
  std::ifstream file(kGoldens / "driver.txt");
  std::string driver;
  std::string recorded_on;
  std::getline(file, driver);
  std::getline(file, recorded_on);
  if (driver != driver_of(device)) return Agreement::other_driver;
  return recorded_on == processor() ? Agreement::exact : Agreement::same_driver;
}

}  // namespace

Difference difference_of(const Image& a, const Image& b) {
  constexpr int kVisible = 25;
  Difference difference;
  difference.picture = a;
  std::uint64_t sum = 0;
  std::uint64_t visible = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int most = 0;
    for (std::size_t k = i; k < i + 4; ++k) {
      const int d = std::abs(int{a.rgba[k]} - int{b.rgba[k]});
      sum += static_cast<std::uint64_t>(d);
      most = std::max(most, d);
      difference.picture.rgba[k] =
          k == i + 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(std::min(4 * d, 255));
    }
    difference.pixels += most > 0 ? 1 : 0;
    visible += most > kVisible ? 1 : 0;
    difference.largest = std::max(difference.largest, most);
  }
  difference.mean = static_cast<double>(sum) / static_cast<double>(a.rgba.size());
  difference.share_visible =
      4.0 * static_cast<double>(visible) / static_cast<double>(a.rgba.size());
  return difference;
}

bool agrees(const Difference& difference, Agreement expected) {
  switch (expected) {
    case Agreement::exact:
      return difference.pixels == 0;
    case Agreement::same_driver:
      return difference.largest <= 12 && difference.mean <= 0.05;
    case Agreement::other_driver:
      break;
  }
  return difference.mean <= 0.25 && difference.share_visible <= 0.005;
}

void expect_golden(const gpu::Device& device, const std::string& name, const Image& image) {
  const std::filesystem::path golden = kGoldens / (name + ".png");
  const std::filesystem::path candidate = kCandidates / (name + ".png");
  std::filesystem::create_directories(kCandidates);
  if (!std::filesystem::exists(golden)) {
    io::write_png(candidate, image);
    FAIL() << "no golden yet: look at " << candidate << ", and copy it to tests/golden if it is "
           << "right (driver: " << driver_of(device) << ")";
  }
  const Image approved = io::read_png(golden);
  ASSERT_EQ(approved.width, image.width);
  ASSERT_EQ(approved.height, image.height);
  const Difference difference = difference_of(image, approved);
  const Agreement expected = expected_agreement(device);
  if (agrees(difference, expected)) return;
  io::write_png(candidate, image);
  const std::filesystem::path shown = kCandidates / (name + "_difference.png");
  io::write_png(shown, difference.picture);
  FAIL() << difference.pixels << " pixels differ, by " << difference.mean << " on average and "
         << difference.largest << " at most, " << 100.0 * difference.share_visible
         << " % of them visibly (allowed: "
         << (expected == Agreement::exact ? "none, on the same driver and processor"
             : expected == Agreement::same_driver
                 ? "0.05 on average, 12 at most, on the same driver"
                 : "0.25 on average, 0.5 % visibly, on another driver")
         << "); see " << candidate << " and " << shown << " (this is " << driver_of(device) << ", "
         << processor() << ")";
}

}  // namespace mesher::test
