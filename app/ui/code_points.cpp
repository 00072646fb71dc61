#include "app/ui/code_points.h"

namespace mesher::app {
namespace {

/// A code point and the number of bytes that encode it.
struct Decoded {
  char32_t code_point;
  std::size_t bytes;
};

/// Decodes the first character of a text that is not empty.
Decoded decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  constexpr Decoded kInvalid{CodePoints::kReplacement, 1};
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return kInvalid;
  char32_t code_point = lead & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return kInvalid;
    code_point = (code_point << 6U) | (byte(i) & 0x3FU);
  }
  const bool is_surrogate = code_point >= 0xD800 && code_point < 0xE000;
  const bool is_overlong = (bytes == 3 && code_point < 0x800) || code_point < 0x80;
  if (is_surrogate || is_overlong || (bytes == 4 && code_point < 0x10000)) return kInvalid;
  return {code_point, bytes};
}

}  // namespace

void CodePoints::add_text(std::string_view text) {
  while (!text.empty()) {
    const Decoded next = decode(text);
    if (next.code_point >= kEnd)
      add(kReplacement);
    else if (next.code_point >= kLatinEnd)
      add(next.code_point);
    text.remove_prefix(next.bytes);
  }
}

void CodePoints::truncate(std::size_t most) {
  std::size_t kept = 0;
  for (char32_t c = 0; c < kEnd; ++c) {
    if (bits_.test(c) && ++kept > most) bits_.reset(c);
  }
}

std::vector<CodeRange> CodePoints::ranges() const {
  std::vector<CodeRange> ranges;
  for (char32_t c = 0; c < kEnd; ++c) {
    if (!bits_.test(c)) continue;
    if (!ranges.empty() && ranges.back().last + 1 == c)
      ranges.back().last = c;
    else
      ranges.push_back({c, c});
  }
  return ranges;
}

}  // namespace mesher::app
