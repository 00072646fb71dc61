#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mesher::app {

/// The keys of an enum of N values, as options take them.
template <class Enum, std::size_t N>
std::vector<std::string> enum_words() {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < N; ++i)
    words.emplace_back(key(static_cast<Enum>(i)));
  return words;
}

/// The value whose key is `word`; the first where there is none.
template <class Enum, std::size_t N>
Enum enum_value(const std::string& word) {
  for (std::size_t i = 0; i < N; ++i) {
    if (key(static_cast<Enum>(i)) == word) return static_cast<Enum>(i);
  }
  return Enum{};
}

}  // namespace mesher::app
