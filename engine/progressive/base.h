#pragma once

#include <cstdint>

#include "engine/simplify/options.h"

namespace mesher {

/// Faces of the base of a progressive mesh, unless the model is small or suffers.
inline constexpr std::uint32_t kUsualBaseFaces = 200;

/// Sets how far `options` simplify a model of so many faces and that diagonal (model units) for the
/// base of a progressive mesh. The base has kUsualBaseFaces, but at most an eighth of the model, so
/// that there is something to refine. It stops earlier where the estimated error would pass
/// kFarFromInput of the diagonal, though not before a quarter of the model is reached: a cube has
/// nothing to refine otherwise. Where the faces cannot be collapsed that far, the base is as coarse
/// as it gets. O(1).
void choose_base(SimplifyOptions& options, std::uint32_t faces, double diagonal);

}  // namespace mesher
