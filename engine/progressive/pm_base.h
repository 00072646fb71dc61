#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/pm_format.h"

namespace mesher {

/// A base mesh as a file has it.
struct PmBase {
  MeshArrays arrays;       ///< positions, origins, twins, sharpness; the rest may be empty
  Array<glm::ivec3> grid;  ///< the positions' numbers; empty where coordinates are floats
};

/// The payload of the base. `base.grid` is what is written where the header has a grid.
Array<std::byte> encode_base(const PmHeader& header, const PmBase& base);

/// Makes a base of a payload; what is wrong with it, or empty. Everything but the invariants that
/// `validate` checks is checked here. O(F log F).
std::string_view decode_base(const PmHeader& header, std::span<const std::byte> payload,
                             PmBase& base);

}  // namespace mesher
