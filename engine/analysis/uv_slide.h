#pragma once

#include "engine/analysis/attributed_surface.h"
#include "engine/analysis/spread.h"
#include "engine/analysis/surface_matches.h"

namespace mesher::analysis {

/// Which of the two surfaces of a comparison is the reference: the one that says what is right.
enum class Reference : std::uint8_t { from, to };

/// Returns how far the texture has slid over the surface: the difference of the texture coordinates
/// at samples of `from` and at the nearest points of `to`, in texels of the reference's base color
/// textures. Of several nearest points the one with the least difference counts, so that seams are
/// no error. Samples without texture coordinates on either side are left out. `matches` are those
/// of the two meshes. O(samples + candidates), parallel; the same for any number of threads.
Spread uv_slide(const AttributedSurface& from, const AttributedSurface& to,
                const SurfaceMatches& matches, Reference reference);

}  // namespace mesher::analysis
