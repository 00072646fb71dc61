#pragma once

#include <string>

#include "engine/core/progress.h"

namespace mesher::io {

/// Returns the first bytes of an open file, at most `most`, without consuming them. Waits until
/// that many have arrived or the file has ended. Empty also for what cannot be looked at, such as a
/// terminal. Throws Cancelled.
std::string peek(int descriptor, std::size_t most, const Progress* progress);

/// If the descriptor is a pipe or a socket, reads it to its end and makes the descriptor a file in
/// memory with its bytes, so that it has a size and can be read more than once, like any other
/// file. The bytes count for a MemoryLimit. `name`: for messages. Throws InputError; Cancelled;
/// LimitError or DeviceError if out of memory.
void spool(int descriptor, const std::string& name, const Progress* progress);

}  // namespace mesher::io
