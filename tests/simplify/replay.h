#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/simplify/observer.h"

namespace mesher::test {

/// Edges whose faces meet at more than 150 degrees.
std::uint64_t count_folds(const Mesh& mesh);

/// Plays records on the mesh that they were taken of, one by one, with `collapse` of engine/mesh,
/// which knows nothing of the decimator: each must be legal. Calls `after_each` with the mesh and
/// the number of collapses so far.
Mesh replay(Mesh mesh, std::span<const CollapseRecord> records,
            const std::function<void(const Mesh&, std::size_t)>& after_each);

/// Whether two meshes are the same surface: equal positions, and faces of equal corners, in any
/// order.
bool is_same_surface(const Mesh& a, const Mesh& b);

}  // namespace mesher::test
