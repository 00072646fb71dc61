#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/codec/pm_format.h"

namespace mesher::progressive {

/// A base mesh as stored in a file.
struct PmBase {
  MeshArrays arrays;       ///< positions, origins, twins, sharpness; the rest may be empty
  Array<glm::ivec3> grid;  ///< quantized positions; empty if coordinates are floats
};

/// Returns the payload of the base. If the header has a grid, `base.grid` is written instead of
/// positions.
Array<std::byte> encode_base(const PmHeader& header, const PmBase& base);

/// Decodes a base. Returns what is wrong, or an empty string. Checks everything except the
/// invariants that `validate` checks. O(F log F).
std::string_view decode_base(const PmHeader& header, std::span<const std::byte> payload,
                             PmBase& base);

}  // namespace mesher::progressive
