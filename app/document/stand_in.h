#pragma once

#include <cstdint>
#include <memory>

#include "engine/mesh/mesh.h"
#include "engine/mesh/statistics.h"

namespace mesher::app {

/// Models with more faces get a stand-in when they are opened.
inline constexpr std::uint32_t kStandInFrom = 1'000'000;

/// Returns a coarse copy of a mesh that any machine draws within a frame. O(V + F).
std::shared_ptr<const Mesh> make_stand_in(const Mesh& mesh, const Statistics& statistics);

}  // namespace mesher::app
