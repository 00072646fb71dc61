#pragma once

/// @file
/// @brief How a long operation reports its progress and is canceled.

#include <functional>
#include <string_view>

namespace mesher {

/// Told how far a long operation is: the finished fraction of all its work, from 0 to 1, which
/// never falls, and what is being done now ("reading"). Returns whether to go on; after false, the
/// operation ends with `Cancelled` and changes nothing.
///
/// Called on any thread, but never on two threads at once, and only when there is something new:
/// some hundred times per operation. It must not throw.
using ProgressCallback = std::function<bool(float fraction, std::string_view stage)>;

}  // namespace mesher
