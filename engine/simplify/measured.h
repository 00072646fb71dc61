#pragma once

#include "engine/simplify/attempts.h"
#include "engine/simplify/simplify.h"
#include "engine/simplify/trace.h"

namespace mesher::simplify {

/// Simplifies once. Each collapse respects the error bound of the options, if any, but the result
/// is not measured. `trace`: filled in if not null. `attempts`: if not null, the last run, which is
/// repeated as far as its shares of the bound allow, and then replaced by this one. Its ids are
/// those of `Trace::before`.
Simplified simplify_unmeasured(Mesh&& mesh, const SimplifyOptions& options, Trace* trace = nullptr,
                               Attempts* attempts = nullptr);

/// Simplifies once and certifies an upper bound of the distance between input and result.
Simplified simplify_certified(Mesh&& mesh, const SimplifyOptions& options);

/// Simplifies, decides whether input and result are within the bound in both directions
/// (`hausdorff_bounds`), and repeats with a tighter bound around the violations. At most kMaxRuns;
/// if no run keeps the bound, the result is the input. The observer sees only the run that is
/// returned.
Simplified simplify_measured(Mesh&& mesh, const SimplifyOptions& options);

inline constexpr int kMaxRuns = 12;

}  // namespace mesher::simplify
