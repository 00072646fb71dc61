#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "engine/subdivide/options.h"

namespace mesher::app {

/// What `subdivide` was told, in words.
struct SubdivideWords {
  std::uint32_t levels = 1;
  std::string scheme = "loop";
  std::string creases = "hoppe94";
  std::string boundary = "edge-only";
  std::string decay = "uniform";
  bool limit = false;
};

/// The words that options take.
std::vector<std::string> scheme_words();
std::vector<std::string> crease_rules_words();
std::vector<std::string> boundary_rounding_words();
std::vector<std::string> crease_decay_words();

/// What the words mean.
SubdivideOptions subdivide_options(const SubdivideWords& words);

/// Reads a model, subdivides it, attributes included, writes it, and reports. Throws DeviceError
/// where that would take more memory than there is.
void run_subdivide(const InputOptions& input, const std::string& output,
                   const SubdivideWords& words, const CommonOptions& common);

}  // namespace mesher::app
