#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/options.h"

namespace mesher::test {

/// Number of edges whose face normals differ by more than 150 degrees.
std::uint64_t count_folds(const Mesh& mesh);

/// Fraction of the area of a mesh that is folded: each folded edge counts the area of its smaller
/// face.
double folded_share(const Mesh& mesh);

/// A policy whose costs are not errors makes no folds. For the others, a fold is an error that
/// competes with other errors: as long as 64 faces are left, new folds stay below a fiftieth of the
/// area. Below 64 faces the error is as large as a face, and there is no guarantee.
void expect_no_harmful_folds(const Mesh& before, const Mesh& after, simplify::CostPolicy policy);

/// Replays records on the mesh from which they were recorded, one by one, with `collapse` of
/// engine/mesh, which is independent of the decimator. Each collapse must be legal. Calls
/// `after_each` with the mesh and the number of collapses so far.
Mesh replay(Mesh mesh, std::span<const simplify::CollapseRecord> records,
            const std::function<void(const Mesh&, std::size_t)>& after_each);

/// Whether two meshes are the same surface: equal positions and faces with equal corners, in any
/// order.
bool is_same_surface(const Mesh& a, const Mesh& b);

}  // namespace mesher::test
