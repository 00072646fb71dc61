#pragma once

#include <cstdint>

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

/// Reads digits; a number past 32 bits gives 0xFFFFFFFF. Returns the first character after them.
/// Pre: is_digit(*p).
const char* read_digits(const char* p, std::uint32_t& value);

/// Reads a whole number with optional sign, at most 18 digits; null where there is none or
/// something else sticks to it.
const char* read_integer(const char* p, std::int64_t& value);

}  // namespace mesher::scan
