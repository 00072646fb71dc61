#pragma once

#include <cstdint>

#include "engine/simplify/options.h"

namespace mesher::progressive {

/// Default number of faces of a progressive mesh's base; smaller models and large errors change it.
inline constexpr std::uint32_t kUsualBaseFaces = 200;

/// Sets how far `options` simplify a model for the base of a progressive mesh. `diagonal`: of the
/// model's bounding box, in model units. The base gets kUsualBaseFaces, but at most an eighth of
/// the model's faces, so that something is left to refine. Simplification stops earlier if the
/// estimated error would exceed kFarFromInput of the diagonal, or 0.5 % of it if the model has
/// lines (simplify::may_have_lines), but not before a quarter of the faces is reached; otherwise a
/// cube would have nothing to refine. If no legal collapse leads that far, the base is as coarse as
/// possible. O(1).
void choose_base(simplify::SimplifyOptions& options, std::uint32_t faces, double diagonal,
                 bool has_lines = false);

}  // namespace mesher::progressive
