#include "engine/analysis/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace mesher::test {
namespace {

__extension__ using Int128 = __int128;

int sign_of(Int128 value) {
  return static_cast<int>(value > 0) - static_cast<int>(value < 0);
}

template <std::size_t kSize>
using IntPoint = std::array<std::int64_t, kSize>;

int exact_sign(const IntPoint<2>& a, const IntPoint<2>& b, const IntPoint<2>& c) {
  const auto d = [&](const IntPoint<2>& p, std::size_t i) { return Int128{p[i] - c[i]}; };
  return sign_of(d(a, 0) * d(b, 1) - d(a, 1) * d(b, 0));
}

int exact_sign(const IntPoint<3>& a, const IntPoint<3>& b, const IntPoint<3>& c,
               const IntPoint<3>& p) {
  const auto d = [&](const IntPoint<3>& q, std::size_t i) { return Int128{q[i] - a[i]}; };
  Int128 sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    sum += d(p, i) * (d(b, j) * d(c, k) - d(b, k) * d(c, j));
  }
  return sign_of(sum);
}

glm::dvec2 real(const IntPoint<2>& p) {
  return {p[0], p[1]};
}
glm::dvec3 real(const IntPoint<3>& p) {
  return {p[0], p[1], p[2]};
}

/// Random integers that floats represent exactly: at most 24 bits, shifted to any magnitude below
/// 2^`bits`.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : random_(seed) {}

  std::int64_t operator()(unsigned bits) {
    const auto shift = static_cast<unsigned>(bits > 24 ? random_() % (bits - 23) : 0);
    const auto digits = static_cast<std::int64_t>(random_() % (1U << std::min(bits, 24U)));
    return (random_() % 2 == 0 ? digits : -digits) << shift;
  }

 private:
  std::mt19937 random_;
};

TEST(Orientation2, AgreesWithIntegersOfAllMagnitudes) {
  Numbers number(1);
  for (const unsigned bits : {2U, 10U, 24U, 40U, 58U}) {
    for (int i = 0; i < 20'000; ++i) {
      std::array<IntPoint<2>, 3> p;
      for (auto& q : p)
        q = {number(bits), number(bits)};
      ASSERT_EQ(analysis::orientation(real(p[0]), real(p[1]), real(p[2])),
                exact_sign(p[0], p[1], p[2]));
    }
  }
}

TEST(Orientation3, AgreesWithIntegersOfAllMagnitudes) {
  Numbers number(2);
  for (const auto& [x_bits, bits] : {std::array{2U, 2U},
                                     {10U, 10U},
                                     {24U, 24U},
                                     {38U, 38U},
                                     // Differences of x that no double represents.
                                     {60U, 28U}}) {
    for (int i = 0; i < 20'000; ++i) {
      std::array<IntPoint<3>, 4> p;
      for (auto& q : p)
        q = {number(x_bits), number(bits), number(bits)};
      ASSERT_EQ(analysis::orientation(real(p[0]), real(p[1]), real(p[2]), real(p[3])),
                exact_sign(p[0], p[1], p[2], p[3]));
    }
  }
}

TEST(Orientation3, AgreesWithIntegersNearThePlane) {
  Numbers number(3);
  std::array<int, 3> met{};
  for (int i = 0; i < 100'000; ++i) {
    const IntPoint<3> a{number(20), number(20), number(20)};
    const IntPoint<3> u{number(18), number(18), number(18)};
    const IntPoint<3> v{number(18), number(18), number(18)};
    const std::int64_t s = number(3);
    const std::int64_t t = number(3);
    IntPoint<3> b = a;
    IntPoint<3> c = a;
    IntPoint<3> d = a;
    for (std::size_t k = 0; k < 3; ++k) {
      b[k] += u[k];
      c[k] += v[k];
      d[k] += s * u[k] + t * v[k];
    }
    // At most one unit from the plane. In double precision the terms are 2^60 times that.
    d[static_cast<std::size_t>(i % 3)] += i % 2;
    const int sign = exact_sign(a, b, c, d);
    ASSERT_EQ(analysis::orientation(real(a), real(b), real(c), real(d)), sign);
    ++met[static_cast<std::size_t>(sign + 1)];
  }
  for (const int count : met)
    EXPECT_GT(count, 1'000);
}

TEST(Orientation3, DetectsOneUlpOnALargePlane) {
  // The plane is x + y + z = 3 * 2^22. Its corners are exact.
  constexpr float kLarge = 3.0F * 0x1p22F;
  const glm::dvec3 a(kLarge, 0, 0);
  const glm::dvec3 b(0, kLarge, 0);
  const glm::dvec3 c(0, 0, kLarge);
  const glm::dvec3 on(0x1p22, 0x1p22, 0x1p22);
  const double step = std::nextafter(0x1p22F, std::numeric_limits<float>::max()) - 0x1p22F;
  EXPECT_EQ(analysis::orientation(a, b, c, on), 0);
  EXPECT_EQ(analysis::orientation(a, b, c, on + glm::dvec3(step, 0, 0)), 1);
  EXPECT_EQ(analysis::orientation(a, b, c, on - glm::dvec3(0, step, 0)), -1);
}

TEST(Orientation3, NeitherOverflowsNorUnderflows) {
  constexpr double kMost = std::numeric_limits<float>::max();
  constexpr double kLeast = std::numeric_limits<float>::denorm_min();
  const auto corner_signs = [](double size, double height) {
    const glm::dvec3 a(-size, -size, 0);
    const glm::dvec3 b(size, -size, 0);
    const glm::dvec3 c(0, size, 0);
    return std::array{analysis::orientation(a, b, c, {0, 0, height}),
                      analysis::orientation(a, b, c, {0, 0, 0}),
                      analysis::orientation(a, b, c, {0, 0, -height})};
  };
  for (const double size : {kLeast, 1.0, kMost}) {
    for (const double height : {kLeast, 1.0, kMost})
      EXPECT_EQ(corner_signs(size, height), (std::array{1, 0, -1})) << size << ' ' << height;
  }
  // The same plane away from the origin, where the difference of heights needs 277 bits.
  EXPECT_EQ(analysis::orientation(glm::dvec3(0, 0, kMost), glm::dvec3(1, 0, kMost),
                                  glm::dvec3(0, 1, kMost), glm::dvec3(0, 0, kLeast)),
            -1);
  EXPECT_EQ(analysis::orientation(glm::dvec3(kMost, kMost, kMost), glm::dvec3(0, 0, kLeast),
                                  glm::dvec3(-kMost, -kMost, -kMost), glm::dvec3(1, 1, 1)),
            0);
}

TEST(Orientation3, ChangesSignWithEachSwap) {
  Numbers number(4);
  for (int i = 0; i < 1'000; ++i) {
    std::array<glm::dvec3, 4> p;
    for (auto& q : p)
      q = {number(60), number(30), number(30)};
    const int sign = analysis::orientation(p[0], p[1], p[2], p[3]);
    EXPECT_EQ(analysis::orientation(p[1], p[0], p[2], p[3]), -sign);
    EXPECT_EQ(analysis::orientation(p[0], p[1], p[3], p[2]), -sign);
    EXPECT_EQ(analysis::orientation(p[3], p[1], p[2], p[0]), -sign);
    EXPECT_EQ(analysis::orientation(p[1], p[2], p[0], p[3]), sign);
  }
}

}  // namespace
}  // namespace mesher::test
