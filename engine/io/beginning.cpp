#include "engine/io/beginning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>

#include "engine/progressive/codec/pm_read.h"

namespace mesher::io {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

/// Returns the first word of the first line that is not a comment.
std::string_view first_word(std::string_view text) {
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return {};
    text.remove_prefix(begin);
    if (text[0] != '#') break;
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end);
  }
  return text.substr(0, text.find_first_of(kBlank));
}

/// "OFF", with letters in front for the attributes that follow.
bool is_off(std::string_view word) {
  return word.ends_with("OFF") && word.size() <= 9 &&
         word.find_first_not_of("STCN4nOF") == std::string_view::npos;
}

bool is_obj_statement(std::string_view word) {
  constexpr std::array kWords{"v", "vt", "vn", "vp", "f",      "o",
                              "g", "s",  "l",  "p",  "usemtl", "mtllib"};
  return std::ranges::find(kWords, word) != kWords.end();
}

bool is_text(std::string_view bytes) {
  return std::ranges::none_of(bytes, [](unsigned char c) {
    return c < ' ' && kBlank.find(static_cast<char>(c)) == std::string_view::npos;
  });
}

bool is_binary_stl(std::string_view bytes) {
  constexpr std::size_t kHeader = 84;
  constexpr std::size_t kNumbers = 12;
  std::array<float, kNumbers> facet{};
  std::uint32_t count = 0;
  if (bytes.size() < kHeader + sizeof facet) return false;
  std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
  if (count == 0) return false;
  std::memcpy(facet.data(), bytes.data() + kHeader, sizeof facet);
  return std::ranges::all_of(facet, [](float x) { return std::isfinite(x); });
}

}  // namespace

std::string_view format_of_beginning(std::string_view bytes) {
  if (progressive::PmReader::is_pm(std::as_bytes(std::span(bytes)))) return ".pm";
  if (bytes.starts_with("glTF")) return ".glb";
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return ".ply";
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // a mark of UTF-8
  const std::string_view word = first_word(bytes);
  if (is_off(word)) return ".off";
  if (!is_text(bytes)) return is_binary_stl(bytes) ? ".stl" : "";
  if (word.starts_with('{')) return ".gltf";
  if (word == "solid") return ".stl";
  return is_obj_statement(word) ? ".obj" : "";
}

}  // namespace mesher::io
