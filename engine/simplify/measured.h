#pragma once

#include <span>

#include "engine/simplify/simplify.h"
#include "engine/simplify/trace.h"

namespace mesher {

/// One run, with the bound of the options kept step by step (if there is one) but not measured.
/// `shares`: for each vertex, with the ids of `Trace::before`, which part of that bound holds
/// around it; empty: all of it. `trace`: written, if there is one.
Simplified simplify_unmeasured(Mesh&& mesh, const SimplifyOptions& options,
                               std::span<const float> shares = {}, Trace* trace = nullptr);

/// One run, and a certified bound for the distance between input and result.
Simplified simplify_certified(Mesh&& mesh, const SimplifyOptions& options);

/// Runs, decides whether input and result are within the bound, both ways (`hausdorff_bounds`), and
/// runs again with a tighter bound around the places that are not. At most kMaxRuns; if none keeps
/// the bound, the result is the input. The observer is told of the run that counts alone.
Simplified simplify_measured(Mesh&& mesh, const SimplifyOptions& options);

inline constexpr int kMaxRuns = 12;

}  // namespace mesher
