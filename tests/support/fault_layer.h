#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace mesher::test {

/// Makes Vulkan calls of a program fail on a cue, by a layer below the program and above the
/// validation layer. For programs that are started with `environment`.
class FaultLayer {
 public:
  /// Throws std::runtime_error if the layer was not built.
  FaultLayer();

  /// The variables of the program's environment.
  std::vector<std::string> environment() const;
  /// The next `count` calls of this name return `result`; allocations only if they are of at least
  /// `least_bytes` bytes. Known names: see fault_layer/fault_layer.cpp.
  struct Cue {
    std::string call;
    VkResult result = VK_SUCCESS;
    int count = 1;
    std::uint64_t least_bytes = 0;
  };
  /// Replaces the cues before.
  void cue(const std::vector<Cue>& cues) const;
  /// Whether all cued calls have failed.
  bool is_over() const { return !std::filesystem::exists(file()); }

 private:
  std::filesystem::path file() const { return folder_ / "cue"; }

  TempFolder folder_;
};

}  // namespace mesher::test
