#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/build/report.h"
#include "engine/mesh/build/second_sides.h"
#include "engine/mesh/build/soup.h"

namespace mesher {

/// Appends exactly n-2 triangles that cover one polygon (indices into `polygon`, same orientation).
///
/// The polygon is projected along its normal (Newell), and ears are clipped best shape first (G.
/// Meisters, "Polygons have ears", 1975), so that concave outlines are correct. A self-intersecting
/// outline also terminates, with the best available triangles. Quads use the diagonal inside, or
/// the shorter one if both or neither are. Orientation tests are exact for floats of similar size.
///
/// O(n log n): reflex corners are looked up in a grid. An outline that needs too many tests is
/// finished without further tests. Pre: n >= 3.
void triangulate(std::span<const glm::vec3> polygon,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Replaces every polygon of the soup by triangles and carries streams and groups along. Drops
/// faces of fewer than three corners and polygons that repeat an earlier one, and counts them in
/// `report`. Polygons that are second sides get vertices of their own, which are appended; returns
/// these. Deterministic. Afterwards `face_start` is empty. Throws Cancelled. Pre: indices are in
/// range; CornerAttributes have no values (see `to_streams`).
std::vector<SheetCopy> triangulate(Soup& soup, BuildReport& report, Progress* progress = nullptr);

}  // namespace mesher
