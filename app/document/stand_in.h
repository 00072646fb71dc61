#pragma once

#include <cstdint>
#include <memory>

#include "engine/mesh/mesh.h"
#include "engine/mesh/statistics.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::app {

/// Models with more faces get a stand-in when they are opened.
inline constexpr std::uint32_t kStandInFrom = 1'000'000;

/// About the number of faces of a stand-in: a software renderer on two cores draws them in less
/// than 33 ms.
inline constexpr std::uint32_t kStandInFaces = 60'000;

/// Returns a coarse copy of a mesh that any machine draws within a frame. O(V + F).
std::shared_ptr<const Mesh> make_stand_in(const Mesh& mesh, const Statistics& statistics);
/// Returns a copy of a level of about the same size, which looks better. Leaves `mesh` at its
/// level. O(splits between the levels). Throws Cancelled.
std::shared_ptr<const Mesh> level_as_stand_in(progressive::ProgressiveMesh& mesh,
                                              Progress* progress);

}  // namespace mesher::app
