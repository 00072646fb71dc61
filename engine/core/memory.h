#pragma once

#include <cstdint>

namespace mesher {

/// Bytes that this process can still fill before the machine or its container runs out: what the
/// system calls available, or what is left of the control group's limit where that is less. The
/// highest number there is where the system does not say.
std::uint64_t available_memory_bytes();

}  // namespace mesher
