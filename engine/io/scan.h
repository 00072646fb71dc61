#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace mesher::scan {

// Scanners over text that ends in readable zero bytes (MappedFile::kPadding), so that none of them
// needs to know where the text ends: a zero byte is no part of any token.

/// White space inside a line. A lone carriage return is one too, so CRLF needs nothing special.
inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

inline bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') <= 9;
}

/// True for what may follow a number: white space, a control character, a comment, a continuation.
inline bool ends_token(char c) {
  return static_cast<unsigned char>(c) <= ' ' || c == '#' || c == '\\';
}

inline const char* skip_blanks(const char* p) {
  while (is_blank(*p))
    ++p;
  return p;
}

/// Reads a decimal number, "inf" or "nan", with or without sign, correctly rounded to single
/// precision: the very bits of strtof. Too large gives infinity, too small zero, as there. Returns
/// the end of the number, or null where there is none or something else sticks to it.
const char* read_float(const char* p, float& value);

/// The same in double precision, for formats that hold doubles and attributes that are scaled.
const char* read_double(const char* p, double& value);

static_assert(std::endian::native == std::endian::little, "eight digits are read as one word");

inline std::uint64_t load_word(const char* p) {
  std::uint64_t word;
  std::memcpy(&word, p, sizeof word);
  return word;
}

/// How many of the eight characters are digits before the first that is not. Borrows and carries
/// only arise at and above that character, so the count is right.
inline unsigned leading_digits(std::uint64_t word) {
  const std::uint64_t other =
      ((word + 0x4646464646464646U) | (word - 0x3030303030303030U)) & 0x8080808080808080U;
  return static_cast<unsigned>(std::countr_zero(other)) / 8;
}

/// Value of the first `count` characters of the word. Pre: they are digits, 1 <= count <= 8.
inline std::uint32_t digits_value(std::uint64_t word, unsigned count) {
  word = (word - 0x3030303030303030U) << (64 - 8 * count);
  word = word * 10 + (word >> 8);
  constexpr std::uint64_t kMask = 0x000000FF000000FFU;
  return static_cast<std::uint32_t>(((word & kMask) * (100 + (1000000ULL << 32)) +
                                     ((word >> 16) & kMask) * (1 + (10000ULL << 32))) >>
                                    32);
}

/// Reads eight digits and more: what read_digits leaves aside.
const char* read_long_digits(const char* p, std::uint32_t& value);

/// Reads digits; a number past 32 bits gives 0xFFFFFFFF. Returns the first character after them.
/// Pre: is_digit(*p).
inline const char* read_digits(const char* p, std::uint32_t& value) {
  const std::uint64_t word = load_word(p);
  const unsigned count = leading_digits(word);
  if (count == 8) return read_long_digits(p, value);
  value = digits_value(word, count);
  return p + count;
}

/// Reads a whole number with optional sign, at most 18 digits; null where there is none or
/// something else sticks to it.
const char* read_integer(const char* p, std::int64_t& value);

}  // namespace mesher::scan
