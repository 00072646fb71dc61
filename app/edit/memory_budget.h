#pragma once

#include <cstdint>
#include <string>

#include "engine/subdivide/subdivide.h"

namespace mesher::app {

/// The free memory, and what is needed besides the mesh of the result.
struct MemoryBudget {
  std::uint64_t available = 0;  ///< bytes
  unsigned copies = 1;          ///< number of copies of the result at the end
  std::uint64_t beside = 0;     ///< bytes per copy of the result besides its mesh
  std::uint64_t held = 0;       ///< bytes that are needed for any result
  bool is_limited = false;      ///< `available` is what --max-memory leaves
};

/// Returns why a subdivision does not fit into memory, as a message with the memory that it needs;
/// empty if it fits. A fifth of the available memory is left free.
std::string subdivision_refusal(const subdivide::SubdivisionSize& size, std::uint32_t levels,
                                const MemoryBudget& budget);

}  // namespace mesher::app
