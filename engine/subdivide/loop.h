#pragma once

#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"

namespace mesher {

/// One step of Loop subdivision with creases. Everything is placed by the smooth masks first, in
/// parallel; what `features` list is then placed anew. `first_of_level`: for each level up to
/// `coarse` the first vertex that was made on it (0 for that of the mesh itself): all but those of the
/// mesh have six neighbours, or lie on a boundary, and where those are follows by arithmetic. `is_last`: without twins and outgoing
/// half-edges. O(F). Throws Cancelled.
Level loop_step(const LevelView& coarse, std::span<const std::uint32_t> first_of_level,
                const Features& features,
                const SubdivideOptions& options, bool is_last);

}  // namespace mesher
