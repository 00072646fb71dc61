#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/report.h"
#include "engine/mesh/soup.h"

namespace mesher {

/// Cuts one polygon into exactly n-2 triangles (indices into `polygon`, same orientation).
/// The polygon is projected along its normal (Newell) and ears are clipped best shape first
/// (G. Meisters, "Polygons have ears", 1975), so concave outlines come out right; one that crosses
/// itself still ends, with the best triangles there are. Quads take the diagonal inside, or the
/// shorter one of two. Orientation tests are exact for float input of similar size.
/// O(n log n): reflex corners are looked up in a grid, and an outline that still costs too many
/// tests is finished without them. Pre: n >= 3.
void triangulate(std::span<const glm::vec3> polygon,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Replaces every polygon of the soup by triangles, attributes carried along; faces of fewer than
/// three corners, and polygons that repeat an earlier one, are dropped. Counts in `report`.
/// Deterministic. Throws Cancelled. Afterwards `face_start` is empty.
/// Pre: indices are in range.
void triangulate(Soup& soup, BuildReport& report, Progress* progress = nullptr);

}  // namespace mesher
