#include "app/input/keys.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "engine/core/error.h"

namespace mesher::app {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

}  // namespace

std::optional<KeyPress> parse_key(std::string_view text) {
  KeyPress key;
  std::string rest = lower(text);
  for (std::size_t plus = rest.find('+'); plus != std::string::npos && plus + 1 < rest.size();
       plus = rest.find('+')) {
    const std::string modifier = rest.substr(0, plus);
    if (modifier == "shift") {
      key.shift = true;
    } else if (modifier == "ctrl" || modifier == "control") {
      key.control = true;
    } else {
      return std::nullopt;
    }
    rest.erase(0, plus + 1);
  }
  if (rest.empty()) return std::nullopt;
  if (rest == "esc") rest = "escape";
  if (rest == "?") {
    rest = "/";
    key.shift = true;
  }
  key.name = rest;
  return key;
}

std::vector<KeyPress> parse_keys(std::string_view text) {
  std::vector<KeyPress> keys;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    const auto key = parse_key(word);
    if (!key) throw UsageError("--keys: '" + word + "' is not a key");
    keys.push_back(*key);
  }
  return keys;
}

std::string to_text(const KeyPress& key) {
  std::string text;
  if (key.control) text += "Ctrl+";
  if (key.shift) text += "Shift+";
  std::string name = key.name == "escape" ? "Esc" : key.name;
  if (name == "pageup") name = "PageUp";
  if (name == "pagedown") name = "PageDown";
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return text + name;
}

}  // namespace mesher::app
