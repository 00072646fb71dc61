#include "app/edit/edit_words.h"

#include <charconv>
#include <sstream>

namespace mesher::app {

EditWords::EditWords(std::string_view text) : text_(text) {
  std::istringstream words(text_);
  words >> name_;
  if (name_.empty()) throw UsageError("an edit is empty");
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    if (equals == 0 || equals == std::string::npos)
      throw UsageError(name_ + ": '" + word + "' is not of the form key=value");
    const bool is_new = values_.emplace(word.substr(0, equals), word.substr(equals + 1)).second;
    if (!is_new) throw UsageError(name_ + ": " + word.substr(0, equals) + " is given twice");
  }
}

std::optional<std::string> EditWords::take(const std::string& key) {
  known_.push_back(key);
  const auto node = values_.extract(key);
  if (node.empty()) return std::nullopt;
  return node.mapped();
}

std::uint32_t EditWords::take_number(const std::string& key,
                                     std::optional<std::uint32_t> otherwise) {
  const std::optional<std::string> text = take(key);
  if (!text && otherwise) return *otherwise;
  if (!text) {
    if (missing_.empty()) missing_ = key;
    return 0;
  }
  std::uint32_t value = 0;
  const char* end = text->data() + text->size();
  const auto [stop, error] = std::from_chars(text->data(), end, value);
  if (error != std::errc() || stop != end) refuse(key, *text);
  return value;
}

float EditWords::take_float(const std::string& key, float least, float most) {
  const std::optional<std::string> taken = take(key);
  if (!taken) {
    if (missing_.empty()) missing_ = key;
    return least;
  }
  const std::string& text = *taken;
  const char* end = text.data() + text.size();
  float value = 0.0F;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const bool is_in_range = value >= least && value <= most;  // false for NaN
  if (error != std::errc() || stop != end || !is_in_range) refuse(key, text);
  return value;
}

void EditWords::expect_no_more() const {
  if (!values_.empty()) {
    std::string known;
    for (const std::string& key : known_)
      known += (known.empty() ? "" : ", ") + key;
    throw UsageError(name_ + ": unknown option '" + values_.begin()->first + "'; " +
                     (known.empty() ? "it takes none" : "it takes " + known));
  }
  if (!missing_.empty()) throw UsageError(name_ + ": " + missing_ + " is missing");
}

void EditWords::refuse(const std::string& key, const std::string& value) const {
  throw UsageError(name_ + ": '" + value + "' is not a value of " + key);
}

}  // namespace mesher::app
