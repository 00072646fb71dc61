#include "engine/io/base64.h"

#include "engine/core/parallel.h"

namespace mesher::io {
namespace {

constexpr std::size_t kCharactersBetweenReports = std::size_t{1} << 18;

int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

}  // namespace

std::optional<std::string> decode_base64(std::string_view text, Progress* progress) {
  for (int padding = 0; padding < 2 && !text.empty() && text.back() == '='; ++padding) {
    text.remove_suffix(1);
  }
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int held = 0;
  bool is_valid = true;
  ordered_chunks(text.size(), kCharactersBetweenReports, progress, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end && is_valid; ++i) {
      const int value = value_of(text[i]);
      is_valid = value >= 0;
      bits = bits << 6 | static_cast<std::uint32_t>(value);
      held += 6;
      if (held < 8) continue;
      held -= 8;
      bytes += static_cast<char>(bits >> held & 0xFFU);
    }
  });
  if (!is_valid) return std::nullopt;
  return bytes;
}

}  // namespace mesher::io
