#pragma once

#include <cstdio>
#include <cstdlib>

/// Aborts with a message if the condition is false, which is a bug in the caller. Checked in Debug
/// builds only; the tests also run in Debug. Never used on data from a file.
#ifdef NDEBUG
#define MESHER_ASSERT(condition) static_cast<void>(sizeof(!(condition)))
#else
#define MESHER_ASSERT(condition)                                                          \
  ((condition) ? static_cast<void>(0)                                                     \
               : (std::fprintf(stderr, "mesher: %s:%d: assertion failed: %s\n", __FILE__, \
                               __LINE__, #condition),                                     \
                  std::abort()))
#endif
