#include "engine/core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/assert.h"

namespace mesher {
namespace {

/// From here on, three significant digits round to the next power of ten.
constexpr double kRoundsToThousand = 999.5;

/// Whole numbers up to here are exact in double precision.
constexpr double kLargestWhole = 9e15;

/// Returns the bytes of the UTF-8 character at the start of a text, or 0 if there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return 0;
  }
  // Forms that are too long, halves of surrogate pairs, and what lies beyond Unicode.
  const unsigned char second = byte(1);
  const bool is_valid = (first != 0xE0 || second >= 0xA0) && (first != 0xED || second < 0xA0) &&
                        (first != 0xF0 || second >= 0x90) && (first != 0xF4 || second < 0x90);
  return is_valid ? length : 0;
}

/// Returns whether a UTF-8 character controls a terminal: those below the space, DEL, and U+0080 to
/// U+009F.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  return first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
}

std::string escape(unsigned char byte) {
  if (byte == '\n') return "\\n";
  if (byte == '\r') return "\\r";
  if (byte == '\t') return "\\t";
  return fmt::format("\\x{:02x}", byte);
}

std::string three_digits(double value) {
  const double size = std::abs(value);
  if (size >= kRoundsToThousand && size <= kLargestWhole) return count_text(std::llround(value));
  return fmt::format("{:.3g}", value);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    if (length > 0 && !is_control(character)) {
      result += character;
    } else {
      for (const char c : character)
        result += escape(static_cast<unsigned char>(c));
    }
    text.remove_prefix(character.size());
  }
  return result;
}

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
