#pragma once

#include <optional>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/io/weld.h"
#include "engine/mesh/build/report.h"
#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Returns which positions become one vertex, or nothing if all stay apart.
///
/// `distance` 0: equal positions (0 and -0 are equal). Otherwise positions in the order of the file
/// each join the nearest earlier vertex within `distance`, or become a vertex. So no position moves
/// by more than `distance`, however long a chain of close positions is, and vertices are further
/// apart than that. Positions that are not finite stay apart. Deterministic.
///
/// O(n) expected; O(n log n) if many positions are equal. Counts the joined ones in `report`.
/// Throws Cancelled. Pre: `distance` is not negative; fewer than 2^32 positions.
std::optional<Weld> joined_positions(const Array<glm::vec3>& positions, double distance,
                                     BuildReport& report, Progress* progress = nullptr);

/// Joins the vertices of a soup as joined_positions does. Attributes, which belong to corners, stay
/// as they are.
void join_vertices(Soup& soup, double distance, Progress* progress = nullptr);

}  // namespace mesher::io
