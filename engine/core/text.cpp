#include "engine/core/text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "engine/core/assert.h"

namespace mesher {
namespace {

/// From here on, three significant digits round to the next power of ten.
constexpr double kRoundsToThousand = 999.5;

/// Whole numbers up to here are exact in double precision.
constexpr double kLargestWhole = 9e15;

std::string three_digits(double value) {
  const double size = std::abs(value);
  if (size >= kRoundsToThousand && size <= kLargestWhole) return count_text(std::llround(value));
  return fmt::format("{:.3g}", value);
}

}  // namespace

std::string count_text(std::int64_t count) {
  // The negation of the least value has no signed representation.
  const auto bits = static_cast<std::uint64_t>(count);
  return count < 0 ? fmt::format("-{}", fmt::group_digits(0 - bits))
                   : fmt::format("{}", fmt::group_digits(bits));
}

std::string count_text(std::int64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count_text(count), noun, count == 1 ? "" : "s");
}

std::string count_phrase(std::int64_t count, std::string_view phrase) {
  std::string text = count_text(count) + " ";
  while (!phrase.empty()) {
    const std::size_t open = phrase.find('{');
    text += phrase.substr(0, open);
    if (open == std::string_view::npos) break;
    const std::size_t bar = phrase.find('|', open);
    const std::size_t close = phrase.find('}', bar);
    MESHER_ASSERT(bar != std::string_view::npos && close != std::string_view::npos);
    text += count == 1 ? phrase.substr(open + 1, bar - open - 1)
                       : phrase.substr(bar + 1, close - bar - 1);
    phrase.remove_prefix(close + 1);
  }
  return text;
}

std::string number_text(double value) {
  return fmt::format("{:.6g}", value);
}

std::string percent_text(double percent) {
  return three_digits(percent) + " %";
}

std::string bytes_text(std::uint64_t bytes) {
  constexpr std::array kUnits{"kB", "MB", "GB", "TB", "PB", "EB"};
  if (bytes < 1000) return count_text(static_cast<std::int64_t>(bytes), "byte");
  double value = static_cast<double>(bytes) / 1000.0;
  std::size_t unit = 0;
  for (; value >= kRoundsToThousand; ++unit)
    value /= 1000.0;
  return fmt::format("{:.3g} {}", value, kUnits.at(unit));
}

std::string seconds_text(double seconds) {
  constexpr double kLongest = 1e12;
  if (!(seconds >= 0.0 && seconds <= kLongest)) return number_text(seconds) + " s";
  // Each limit is the first duration that rounds to one of the next unit.
  if (seconds < 1e-7) return "0 ms";
  if (seconds < 0.9995) return fmt::format("{:.3g} ms", 1e3 * seconds);
  if (seconds < 59.95) return fmt::format("{:.3g} s", seconds);
  const std::int64_t whole = std::llround(seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  const std::int64_t minutes = std::llround(seconds / 60.0);
  return fmt::format("{} h {} min", count_text(minutes / 60), minutes % 60);
}

}  // namespace mesher
