#pragma once

#include <string>

namespace mesher::test {

/// More repetitions than a reader survives that recurses for each of them.
inline constexpr int kMany = 100000;

inline std::string repeated(const std::string& text, int times) {
  std::string all;
  all.reserve(text.size() * static_cast<std::size_t>(times));
  for (int i = 0; i < times; ++i)
    all += text;
  return all;
}

}  // namespace mesher::test
