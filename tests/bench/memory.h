#pragma once

#include <cstdint>

namespace mesher::bench {

/// Measures how far the resident memory of the process rises above its value at construction. Needs
/// the /proc file system of Linux; 0 where the high-water mark cannot be reset.
class PeakMemory {
 public:
  PeakMemory();
  std::uint64_t rise_bytes() const;

 private:
  std::uint64_t start_ = 0;
};

}  // namespace mesher::bench
