#include "engine/io/scan.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace mesher {
namespace {

std::string padded(const std::string& text) {
  return text + std::string(64, '\0');
}

/// Compares with strtof, bit by bit.
void expect_as_strtof(const std::string& text) {
  const std::string source = padded(text);
  float value = -1.0F;
  const char* const end = io::scan::read_float(source.c_str(), value);
  ASSERT_NE(end, nullptr) << text;
  EXPECT_EQ(end - source.c_str(), static_cast<std::ptrdiff_t>(text.size())) << text;
  const float expected = std::strtof(text.c_str(), nullptr);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(value), std::bit_cast<std::uint32_t>(expected)) << text;
  double wide = -1.0;
  ASSERT_NE(io::scan::read_double(source.c_str(), wide), nullptr) << text;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(wide),
            std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)))
      << text;
}

TEST(Scan, ReadsDifficultFloats) {
  for (const char* text : {"0",
                           "-0",
                           "0.0",
                           "1",
                           "+1",
                           "-1.5",
                           ".5",
                           "5.",
                           "1e5",
                           "1E-5",
                           "1e+5",
                           "123456789",
                           "16777217",
                           "16777219",
                           "16777217.0000000001",
                           "0.1",
                           "3.14159265358979323846",
                           "1.00000005960464477539",
                           "1.000000059604644775390625",
                           "1.0000000596046447753906250001",
                           "1e38",
                           "3.4028235e38",
                           "3.4028236e38",
                           "3.4028235677973366e38",
                           "1e39",
                           "-1e999",
                           "1e-37",
                           "1e-45",
                           "7e-46",
                           "8e-46",
                           "1e-999",
                           "0.000000000000000000000000000000000000000000001",
                           "1.17549435e-38",
                           "1.1754942e-38",
                           "340282350000000000000000000000000000000",
                           "12345678901234567890123456789",
                           "0.12345678901234567890123456789",
                           "00000000000000000000000000000001",
                           "9007199254740993",
                           "1e22",
                           "1e23",
                           "inf",
                           "-inf",
                           "infinity",
                           "nan",
                           "0e99999999999",
                           "0.0000001e45"}) {
    expect_as_strtof(text);
  }
  expect_as_strtof("0." + std::string(500, '0') + "1e480");
  expect_as_strtof(std::string(500, '9'));
  expect_as_strtof("1" + std::string(100000, '0'));
}

TEST(Scan, ReadsRandomFloatsLikeStrtof) {
  std::mt19937_64 random(7);
  char text[64];
  for (int i = 0; i < 200000; ++i) {
    const auto bits = static_cast<std::uint32_t>(random());
    const float value = std::bit_cast<float>(bits);
    if (!std::isfinite(value)) continue;
    const char* const formats[] = {"%.9g", "%.6g", "%f", "%.8e", "%.17g", "%.3f"};
    std::snprintf(text, sizeof text, formats[i % 6],
                  static_cast<double>(std::abs(value) > 1e30F ? 1 / value : value));
    expect_as_strtof(text);
    // Halfway between two floats, plus or minus a digit far behind.
    const double halfway =
        (static_cast<double>(value) + static_cast<double>(std::nextafter(value, INFINITY))) / 2;
    std::snprintf(text, sizeof text, "%.17g", halfway);
    expect_as_strtof(text);
  }
}

TEST(Scan, RejectsTextThatIsNotANumber) {
  for (const char* text : {"", " ", "-", "+", ".", "e5", "1e", "1e+", "1.2.3", "1-2", "0x10", "1,5",
                           "--1", "+-1", "nanx", "1f", "1/2"}) {
    const std::string source = padded(text);
    float value = 0.0F;
    EXPECT_EQ(io::scan::read_float(source.c_str(), value), nullptr) << text;
  }
}

TEST(Scan, ReadsDigits) {
  const auto digits = [](const std::string& text) {
    std::uint32_t value = 0;
    const std::string source = padded(text + "/");
    EXPECT_EQ(*io::scan::read_digits(source.c_str(), value), '/') << text;
    return value;
  };
  EXPECT_EQ(digits("7"), 7U);
  EXPECT_EQ(digits("1234567"), 1234567U);
  EXPECT_EQ(digits("12345678"), 12345678U);
  EXPECT_EQ(digits("4294967295"), 4294967295U);
  EXPECT_EQ(digits("4294967296"), 4294967295U);
  EXPECT_EQ(digits("000000000000000000012"), 12U);
  EXPECT_EQ(digits(std::string(1000, '9')), 4294967295U);
}

TEST(Scan, ReadsIntegers) {
  std::int64_t value = 0;
  EXPECT_NE(io::scan::read_integer(padded("-12").c_str(), value), nullptr);
  EXPECT_EQ(value, -12);
  EXPECT_NE(io::scan::read_integer(padded("+123456789012345678").c_str(), value), nullptr);
  EXPECT_EQ(value, 123456789012345678);
  for (const char* text : {"", "-", "1.5", "1x", "1234567890123456789"}) {
    EXPECT_EQ(io::scan::read_integer(padded(text).c_str(), value), nullptr) << text;
  }
}

}  // namespace
}  // namespace mesher
