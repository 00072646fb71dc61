#pragma once

#include "engine/simplify/simplify.h"

namespace mesher {

/// One run, with the bound of the options kept step by step (if there is one) but not measured.
Simplified simplify_unmeasured(Mesh&& mesh, const SimplifyOptions& options);

/// Runs, measures the distance between input and result both ways (`surface_distance`, samples and
/// vertices), and runs again with a tighter bound until what is measured keeps the bound that was
/// asked for. At most kMaxRuns; if none keeps it, the result is the input.
/// The observer is told of the run that counts alone.
Simplified simplify_measured(Mesh&& mesh, const SimplifyOptions& options);

inline constexpr int kMaxRuns = 6;

}  // namespace mesher
