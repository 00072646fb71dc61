#include "engine/io/scan.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace mesher::io::scan {
namespace {

constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int kLargestExactPower = 22;
constexpr std::uint32_t kWholePowers[] = {1,      10,      100,      1000,     10000,
                                          100000, 1000000, 10000000, 100000000};

/// A decimal number as written: mantissa * 10^exponent. Exact while `digits` <= 19.
struct Decimal {
  std::uint64_t mantissa = 0;
  int digits = 0;
  int exponent = 0;
};

inline const char* read_mantissa_digits(const char* p, Decimal& decimal) {
  for (;;) {
    const std::uint64_t word = load_word(p);
    const unsigned count = leading_digits(word);
    if (count == 0) return p;
    decimal.mantissa = decimal.mantissa * kWholePowers[count] + digits_value(word, count);
    decimal.digits += static_cast<int>(count);
    p += count;
    // Past 24 digits the slow path takes over, so counting on is useless.
    if (count < 8 || decimal.digits > 24) return p;
  }
}

/// Reads a plain short decimal. Returns null if there is none; the slow path then decides.
inline const char* read_decimal(const char* p, Decimal& decimal) {
  // One digit before the decimal point is by far the most common case. More digits are read eight
  // at a time.
  if (is_digit(*p) && !is_digit(p[1])) {
    decimal.mantissa = static_cast<std::uint64_t>(*p - '0');
    decimal.digits = 1;
    ++p;
  } else {
    p = read_mantissa_digits(p, decimal);
  }
  if (*p == '.') {
    const int whole = decimal.digits;
    p = read_mantissa_digits(p + 1, decimal);
    decimal.exponent = whole - decimal.digits;
  }
  if (decimal.digits == 0 || decimal.digits > 19) return nullptr;
  if (*p == 'e' || *p == 'E') {
    const bool negative = p[1] == '-';
    p += negative || p[1] == '+' ? 2 : 1;
    if (!is_digit(*p)) return nullptr;
    std::uint32_t exponent = 0;
    p = read_digits(p, exponent);
    if (exponent > 1000) return nullptr;
    decimal.exponent += negative ? -static_cast<int>(exponent) : static_cast<int>(exponent);
  }
  return ends_token(*p) ? p : nullptr;
}

/// Returns the nearest double, by one correctly rounded operation on two exact doubles, or NaN if
/// that is not possible (W. Clinger, "How to read floating point numbers accurately", 1990).
double nearest_double(const Decimal& decimal) {
  if (decimal.mantissa > (1ULL << 53) || std::abs(decimal.exponent) > kLargestExactPower) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto mantissa = static_cast<double>(decimal.mantissa);
  return decimal.exponent < 0 ? mantissa / kPowersOfTen[-decimal.exponent]
                              : mantissa * kPowersOfTen[decimal.exponent];
}

/// Returns whether rounding the nearest double again gives the nearest float.
///
/// It does unless the double lies exactly halfway between two floats: the decimal itself may lie on
/// either side. Returns false for NaN, subnormal and overflowing values too, which the slow path
/// handles.
bool is_double_rounding_safe(double value) {
  constexpr std::uint64_t kBelowFloat = (1ULL << 29) - 1;
  constexpr std::uint64_t kHalfway = 1ULL << 28;
  if ((std::bit_cast<std::uint64_t>(value) & kBelowFloat) == kHalfway) return false;
  return value == 0.0 || (value >= static_cast<double>(std::numeric_limits<float>::min()) &&
                          value <= static_cast<double>(std::numeric_limits<float>::max()));
}

/// Returns whether an out-of-range decimal is too large rather than too small. Pre: it is one of
/// the two.
bool is_huge(const char* p, const char* end) {
  const char* const mark = std::find_if(p, end, [](char c) { return c == 'e' || c == 'E'; });
  std::int64_t exponent = 0;
  if (mark != end) {
    const bool negative = mark[1] == '-';
    std::uint32_t magnitude = 0;
    read_digits(mark + (negative || mark[1] == '+' ? 2 : 1), magnitude);
    exponent = negative ? -static_cast<std::int64_t>(magnitude) : magnitude;
  }
  end = mark;
  std::int64_t whole_digits = 0;
  while (p < end && *p == '0')
    ++p;
  for (; p < end && is_digit(*p); ++p)
    ++whole_digits;
  if (whole_digits == 0 && p < end) {
    for (++p; p < end && *p == '0'; ++p)
      --whole_digits;
  }
  return whole_digits + exponent > 0;
}

template <class Float>
const char* read_slowly(const char* p, Float& value) {
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  if (*p == '-') return nullptr;
  const char* end = p;
  while (!ends_token(*end))
    ++end;
  const std::from_chars_result result = std::from_chars(p, end, value);
  if (result.ec == std::errc::invalid_argument || result.ptr != end) return nullptr;
  if (result.ec == std::errc::result_out_of_range) {
    value = is_huge(p, end) ? std::numeric_limits<Float>::infinity() : Float{0};
  }
  if (negative) value = -value;
  return end;
}

}  // namespace

const char* read_float(const char* p, float& value) {
  const bool negative = *p == '-';
  Decimal decimal;
  const char* const end = read_decimal(p + (negative || *p == '+' ? 1 : 0), decimal);
  if (end == nullptr) return read_slowly(p, value);
  const double nearest = nearest_double(decimal);
  if (!is_double_rounding_safe(nearest)) return read_slowly(p, value);
  value = static_cast<float>(negative ? -nearest : nearest);
  return end;
}

const char* read_coordinate(const char* p, float& value, double& error) {
  const bool negative = *p == '-';
  Decimal decimal;
  const char* const end = read_decimal(p + (negative || *p == '+' ? 1 : 0), decimal);
  double nearest = end == nullptr ? std::nan("") : nearest_double(decimal);
  if (is_double_rounding_safe(nearest)) {
    const auto rounded = static_cast<float>(nearest);
    error = std::max(error, std::abs(nearest - static_cast<double>(rounded)));
    value = negative ? -rounded : rounded;
    return end;
  }
  const char* const slow_end = read_slowly(p, value);
  if (slow_end == nullptr || read_slowly(p, nearest) == nullptr) return slow_end;
  const double distance = std::abs(nearest - static_cast<double>(value));
  if (std::isfinite(distance)) error = std::max(error, distance);
  return slow_end;
}

const char* read_double(const char* p, double& value) {
  const bool negative = *p == '-';
  Decimal decimal;
  const char* const end = read_decimal(p + (negative || *p == '+' ? 1 : 0), decimal);
  const double nearest = end == nullptr ? std::nan("") : nearest_double(decimal);
  if (std::isnan(nearest)) return read_slowly(p, value);
  value = negative ? -nearest : nearest;
  return end;
}

const char* read_long_digits(const char* p, std::uint32_t& value) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  std::uint64_t sum = 0;
  for (; is_digit(*p); ++p) {
    sum = sum * 10 + static_cast<std::uint64_t>(*p - '0');
    if (sum > kMost) sum = kMost;
  }
  value = static_cast<std::uint32_t>(sum);
  return p;
}

const char* read_integer(const char* p, std::int64_t& value) {
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  const char* const first = p;
  std::int64_t sum = 0;
  for (; is_digit(*p); ++p) {
    if (p - first >= 18) return nullptr;
    sum = sum * 10 + (*p - '0');
  }
  if (p == first || !ends_token(*p)) return nullptr;
  value = negative ? -sum : sum;
  return p;
}

}  // namespace mesher::io::scan
