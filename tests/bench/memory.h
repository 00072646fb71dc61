#pragma once

#include <cstdint>

namespace mesher::bench {

/// How far the process's resident memory rises above what it is at construction. Needs Linux's
/// /proc; 0 where that cannot be reset.
class PeakMemory {
 public:
  PeakMemory();
  std::uint64_t rise_bytes() const;

 private:
  std::uint64_t start_ = 0;
};

}  // namespace mesher::bench
