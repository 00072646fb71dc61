#pragma once

#include "engine/simplify/simplify.h"

namespace mesher {

/// Simplifies as `simplify` does, but leaves out whole parts that are smaller than the error, so
/// that the faces go to the rest. A part is a connected component, together with those that it
/// touches at bow-tie vertices; its size is the diagonal of its box.
///
/// A run without pruning gives the estimated error. Parts smaller than that are left out of a
/// second run, those smaller than a half, a quarter and an eighth of it out of further ones. The
/// best run counts: the one that comes closest to the target, then that of the smallest error. If
/// the target is still missed, all of that is repeated with the new error, at most kMaxPrunings
/// times. The largest part always stays.
///
/// The estimated error of the report counts the distance of the pruned parts from the result, and a
/// certified bound holds for the whole input. `vertex_source` and `face_source` hold ids of the
/// input. The same input and options give the same bytes for any number of threads. Takes the time
/// of up to five runs and measurements per repetition, and a copy of the mesh. Throws Cancelled.
/// Pre: the mesh is valid; `max_error` is infinite (a pruned part may be anywhere); no observer (no
/// sequence of collapses leads to the result).
[[nodiscard]] Simplified simplify_pruned(Mesh&& mesh, const SimplifyOptions& options);

inline constexpr int kMaxPrunings = 4;

}  // namespace mesher
