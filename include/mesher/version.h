#pragma once

/// @file
/// @brief The version of the library.

#include <mesher/export.h>

namespace mesher {

/// Returns the version of the library that runs, such as "0.2.0".
MESHER_API const char* version();

}  // namespace mesher
