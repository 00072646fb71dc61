#pragma once

#include <cstdint>
#include <string>

#include "engine/subdivide/subdivide.h"

namespace mesher::app {

/// "1.5 GB"
std::string bytes_text(std::uint64_t bytes);

/// What there is to fill.
struct MemoryBudget {
  std::uint64_t available = 0;  ///< bytes
  unsigned copies = 1;          ///< how often the result is held at the end
  std::uint64_t beside = 0;     ///< bytes that the result takes beside its mesh, once
  std::uint64_t held = 0;       ///< bytes that are taken whatever the result
};

/// Why a subdivision cannot be done here, in a person's words, with what it would take; empty where
/// it can. A fifth of what is available is left alone.
std::string subdivision_refusal(const SubdivisionSize& size, std::uint32_t levels,
                                const MemoryBudget& budget);

}  // namespace mesher::app
