#pragma once

#include <glm/vec3.hpp>

#include "engine/analysis/attributed_surface.h"
#include "engine/analysis/spread.h"
#include "engine/analysis/surface_matches.h"

namespace mesher::analysis {

/// Returns a color in CIE L*a*b* (D65) from sRGB primaries, linear in light, 0 to 1.
glm::dvec3 lab_of(const glm::dvec3& linear);
/// Returns the difference of two colors in L*a*b* as CIE defined it in 1976. About 2.3 can just be
/// seen.
double delta_e_76(const glm::dvec3& a, const glm::dvec3& b);
/// Returns the difference as CIE defined it in 2000 (G. Sharma, W. Wu, E. Dalal, "The CIEDE2000
/// color-difference formula", 2005). About 1 can just be seen.
double delta_e_2000(const glm::dvec3& a, const glm::dvec3& b);

/// Differences of vertex colors by both formulas.
struct ColorDifference {
  Spread cie76;
  Spread ciede2000;
};

/// Returns whether a surface has vertex colors, COLOR_0.
bool has_vertex_colors(const AttributedSurface& surface);

/// Returns the difference of the vertex colors at samples of `from` and at the nearest points of
/// `to`; of several, the one with the least difference by the first formula counts. Alpha does not
/// count. `matches` are those of the two meshes. O(samples + candidates), parallel; the same for
/// any number of threads. Pre: both have vertex colors.
ColorDifference color_difference(const AttributedSurface& from, const AttributedSurface& to,
                                 const SurfaceMatches& matches);

}  // namespace mesher::analysis
