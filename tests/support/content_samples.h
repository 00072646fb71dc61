#pragma once

#include <string>
#include <vector>

#include "engine/mesh/contents.h"

namespace mesher::test {

/// A file with one kind of content, and words of which one names its loss.
struct ContentSample {
  Content kind;
  std::string extension;
  std::string bytes;
  std::vector<std::string> words;
};

/// Returns files that together hold every kind of content.
std::vector<ContentSample> content_samples();

/// Returns whether any of the losses has any of the words.
bool names_any(const std::vector<std::string>& losses, const std::vector<std::string>& words);

}  // namespace mesher::test
