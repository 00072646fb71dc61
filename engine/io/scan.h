#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace mesher::io::scan {

// Scanners over text that ends in readable zero bytes (MappedFile::kPadding). They need not know
// where the text ends, because a zero byte is never part of a token.

/// Returns whether `c` is white space inside a line. A lone carriage return counts, so CRLF needs
/// no special case.
inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

inline bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') <= 9;
}

/// Returns whether `c` may follow a number: white space, a control character, a comment or a
/// continuation.
inline bool ends_token(char c) {
  return static_cast<unsigned char>(c) <= ' ' || c == '#' || c == '\\';
}

inline const char* skip_blanks(const char* p) {
  while (is_blank(*p))
    ++p;
  return p;
}

/// Reads a decimal number, "inf" or "nan" with optional sign, and rounds it correctly to single
/// precision.
///
/// The result has the same bits as strtof's. Too large a number gives infinity and too small a
/// number gives zero, as with strtof. Returns the end of the number, or null if there is no number
/// or another character follows it directly.
const char* read_float(const char* p, float& value);

/// Does the same as read_float, and raises `error` to the distance between the number as written
/// and the result, if that is larger. Infinite and NaN results have no distance.
const char* read_coordinate(const char* p, float& value, double& error);

/// Reads a number in double precision, for formats that hold doubles and for attributes that are
/// scaled.
const char* read_double(const char* p, double& value);

static_assert(std::endian::native == std::endian::little, "eight digits are read as one word");

inline std::uint64_t load_word(const char* p) {
  std::uint64_t word;
  std::memcpy(&word, p, sizeof word);
  return word;
}

/// Returns how many of the eight characters are digits before the first non-digit. Borrows and
/// carries arise only at and above that character, so the count is correct.
inline unsigned leading_digits(std::uint64_t word) {
  const std::uint64_t other =
      ((word + 0x4646464646464646U) | (word - 0x3030303030303030U)) & 0x8080808080808080U;
  return static_cast<unsigned>(std::countr_zero(other)) / 8;
}

/// Returns the value of the first `count` characters of the word. Pre: they are digits, 1 <= count
/// <= 8.
inline std::uint32_t digits_value(std::uint64_t word, unsigned count) {
  word = (word - 0x3030303030303030U) << (64 - 8 * count);
  word = word * 10 + (word >> 8);
  constexpr std::uint64_t kMask = 0x000000FF000000FFU;
  return static_cast<std::uint32_t>(((word & kMask) * (100 + (1000000ULL << 32)) +
                                     ((word >> 16) & kMask) * (1 + (10000ULL << 32))) >>
                                    32);
}

/// Reads eight or more digits; read_digits calls it.
const char* read_long_digits(const char* p, std::uint32_t& value);

/// Reads digits and returns the first character after them. A number over 32 bits gives 0xFFFFFFFF.
/// Pre: is_digit(*p).
inline const char* read_digits(const char* p, std::uint32_t& value) {
  const std::uint64_t word = load_word(p);
  const unsigned count = leading_digits(word);
  if (count == 8) return read_long_digits(p, value);
  value = digits_value(word, count);
  return p + count;
}

/// Reads an integer with optional sign and at most 18 digits. Returns null if there is none or
/// another character follows it directly.
const char* read_integer(const char* p, std::int64_t& value);

}  // namespace mesher::io::scan
