#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/progress.h"

namespace mesher::io {

/// An attribute of decoded Draco data.
struct DracoAttribute {
  std::uint32_t components = 0;
  bool is_fraction = false;  ///< the decoder has turned normalized integers into fractions
  Array<float> values;
};

/// Decoded Draco data.
struct DracoMesh {
  std::uint32_t points = 0;
  Array<std::uint32_t> indices;            ///< three per triangle
  std::vector<DracoAttribute> attributes;  ///< in the order of the ids asked for
};

/// Decodes a triangle mesh, in a child process with limits, because the library has crashed on
/// damaged data. Returns nothing and sets `problem` if the data is damaged, lacks an attribute, or
/// ends the child. Every index is below `points`, and every attribute has a value for each point.
/// Throws DeviceError; Cancelled.
std::optional<DracoMesh> decode_draco(std::string_view bytes, std::span<const std::uint32_t> ids,
                                      std::string& problem, Progress* progress = nullptr);

}  // namespace mesher::io
