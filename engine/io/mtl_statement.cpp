#include "engine/io/mtl_statement.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

namespace mesher::io {
namespace {

constexpr std::string_view kMtlBlanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kMtlBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kMtlBlanks) + 1 - begin);
}

/// Returns the finite number that a word is.
std::optional<float> number_in(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool is_number = error == std::errc() && end == word.data() + word.size();
  if (!is_number || !std::isfinite(static_cast<float>(value))) return std::nullopt;
  return static_cast<float>(value);
}

/// Reads the options of a map and leaves the name of its file.
class MapOptions {
 public:
  MapOptions(std::string_view text, MtlMap& map) : text_(trimmed(text)), map_(map) {}

  /// Returns the text after the options. A word that is no option begins the name.
  std::string_view run() {
    while (text_.starts_with('-')) {
      const std::string_view before = text_;
      const std::string_view option = next_word(text_);
      if (!read(option)) return before;
      text_ = trimmed(text_);
    }
    return text_;
  }

 private:
  bool read(std::string_view option) {
    if (option == "-s" || option == "-o" || option == "-t") {
      read_vector(option[1]);
    } else if (option == "-bm") {
      map_.strength = number().value_or(1.0F);
    } else if (option == "-clamp") {
      map_.clamps = word() == "on";
    } else if (option == "-imfchan") {
      const std::string_view channel = word();
      map_.channel = channel.empty() ? '\0' : channel.front();
    } else if (option == "-mm") {
      const float base = number().value_or(0.0F);
      const float gain = number().value_or(1.0F);
      map_.has_others = map_.has_others || base != 0.0F || gain != 1.0F;
    } else if (option == "-boost" || option == "-texres") {
      number();
      map_.has_others = true;
    } else if (option == "-blendu" || option == "-blendv" || option == "-cc") {
      const bool is_usual = word() == (option == "-cc" ? "off" : "on");
      map_.has_others = map_.has_others || !is_usual;
    } else if (option == "-type") {
      word();
      map_.has_others = true;
    } else {
      return false;
    }
    return true;
  }

  std::string_view word() {
    const std::string_view word = next_word(text_);
    map_.is_malformed = map_.is_malformed || word.empty();
    return word;
  }

  std::optional<float> number() {
    const std::optional<float> value = number_in(word());
    map_.is_malformed = map_.is_malformed || !value;
    return value;
  }

  /// Reads one to three numbers.
  void read_vector(char kind) {
    const float usual = kind == 's' ? 1.0F : 0.0F;
    glm::vec3 value(usual);
    value.x = number().value_or(usual);
    for (int i = 1; i < 3; ++i) {
      std::string_view rest = text_;
      const std::optional<float> further = number_in(next_word(rest));
      if (!further) break;
      value[i] = *further;
      text_ = rest;
    }
    if (kind == 's') map_.scale = value;
    if (kind == 'o') map_.offset = value;
    if (value.z != usual || (kind == 't' && value != glm::vec3(0.0F))) map_.has_others = true;
  }

  std::string_view text_;
  MtlMap& map_;
};

}  // namespace

MtlStatement split_mtl(std::string_view line) {
  line = trimmed(line);
  const std::size_t end = std::min(line.find_first_of(kMtlBlanks), line.size());
  MtlStatement statement{std::string(line.substr(0, end)), trimmed(line.substr(end))};
  for (char& c : statement.keyword) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return statement;
}

std::string_view next_word(std::string_view& text) {
  text = trimmed(text);
  if (text.starts_with('#')) text = {};
  const std::string_view word = text.substr(0, text.find_first_of(kMtlBlanks));
  text.remove_prefix(word.size());
  return word;
}

std::optional<float> mtl_number(std::string_view rest) {
  return number_in(next_word(rest));
}

std::optional<glm::vec3> mtl_color(std::string_view rest) {
  const std::optional<float> first = number_in(next_word(rest));
  if (!first) return std::nullopt;
  glm::vec3 color(*first);
  for (int i = 1; i < 3; ++i) {
    const std::string_view word = next_word(rest);
    if (word.empty()) break;
    const std::optional<float> value = number_in(word);
    if (!value) return std::nullopt;
    color[i] = *value;
  }
  return color;
}

bool is_mtl_map(std::string_view keyword) {
  constexpr std::string_view kOthers[] = {"bump", "norm", "disp", "decal", "refl"};
  return keyword.starts_with("map_") ||
         std::find(std::begin(kOthers), std::end(kOthers), keyword) != std::end(kOthers);
}

MtlMap parse_mtl_map(const MtlStatement& statement) {
  MtlMap map;
  std::string_view file = MapOptions(statement.rest, map).run();
  if (file.size() >= 2 && file.front() == '"' && file.back() == '"')
    file = file.substr(1, file.size() - 2);
  map.file = file;
  return map;
}

}  // namespace mesher::io
