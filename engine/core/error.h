#pragma once

// The engine throws the exceptions of the library's face. They are caught only in `main`, in
// command dispatch, and at the end of a background job.
#include <mesher/error.h>  // IWYU pragma: export
