#pragma once

#include <cstdio>
#include <cstdlib>

/// A caller's bug. Checked in Debug builds only; the tests run those too. Never used on data that
/// came from a file.
#ifdef NDEBUG
#define MESHER_ASSERT(condition) static_cast<void>(sizeof(!(condition)))
#else
#define MESHER_ASSERT(condition)                                                                 \
  ((condition)                                                                                   \
       ? static_cast<void>(0)                                                                    \
       : (std::fprintf(stderr, "%s:%d: assertion failed: %s\n", __FILE__, __LINE__, #condition), \
          std::abort()))
#endif
