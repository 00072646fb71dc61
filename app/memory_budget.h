#pragma once

#include <cstdint>
#include <string>

#include "engine/subdivide/subdivide.h"

namespace mesher::app {

/// "1.5 GB"
std::string bytes_text(std::uint64_t bytes);

/// Why a subdivision cannot be done here, in a person's words, with what it would take; empty where
/// it can. `available`: bytes that may be filled, of which a fifth is left alone. `copies`: how
/// often the result is held at the end.
std::string subdivision_refusal(const SubdivisionSize& size, std::uint32_t levels,
                                std::uint64_t available, unsigned copies);

}  // namespace mesher::app
