#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/options.h"

namespace mesher::test {

/// Edges whose faces meet at more than 150 degrees.
std::uint64_t count_folds(const Mesh& mesh);

/// The part of a mesh's area that is folded: of each folded edge the area of its smaller face.
double folded_share(const Mesh& mesh);

/// A policy whose costs are not errors makes no fold at all. For the others a fold is harm that
/// competes with the error: as long as 64 faces are left the new ones stay below a fiftieth of the
/// area. Below that the error is as large as a face, and nothing is promised.
void expect_no_harmful_folds(const Mesh& before, const Mesh& after, CostPolicy policy);

/// Plays records on the mesh that they were taken of, one by one, with `collapse` of engine/mesh,
/// which knows nothing of the decimator: each must be legal. Calls `after_each` with the mesh and
/// the number of collapses so far.
Mesh replay(Mesh mesh, std::span<const CollapseRecord> records,
            const std::function<void(const Mesh&, std::size_t)>& after_each);

/// Whether two meshes are the same surface: equal positions, and faces of equal corners, in any
/// order.
bool is_same_surface(const Mesh& a, const Mesh& b);

}  // namespace mesher::test
