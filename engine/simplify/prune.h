#pragma once

#include "engine/simplify/simplify.h"

namespace mesher::simplify {

/// Simplifies as `simplify` does, but removes whole parts that are smaller than the error, so that
/// their faces are available to the rest. A part is a connected component, together with those that
/// it touches at bow-tie vertices. Its size is the diagonal of its bounding box.
///
/// The first run does not prune and yields the estimated error. A second run leaves out the parts
/// smaller than that error; further runs leave out those smaller than a half, a quarter and an
/// eighth of it. The best run is the one closest to the target, then the one of the smallest error.
/// If it still misses the target, the procedure repeats with the new error, at most kMaxPrunings
/// times. The largest part is always kept.
///
/// The estimated error of the report includes the distance of the pruned parts from the result, and
/// a certified bound holds for the whole input. `vertex_source` and `face_source` hold ids of the
/// input. The same input and options yield the same bytes for any number of threads.
///
/// Pre: the mesh is valid; `max_error` is infinite, because a pruned part may be at any distance;
/// no observer, because no sequence of collapses leads to the result. Takes the time of up to five
/// runs and measurements per repetition, and a copy of the mesh. Throws Cancelled.
[[nodiscard]] Simplified simplify_pruned(Mesh&& mesh, const SimplifyOptions& options);

inline constexpr int kMaxPrunings = 4;

}  // namespace mesher::simplify
