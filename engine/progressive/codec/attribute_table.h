#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/attributes.h"
#include "engine/progressive/codec/layer_format.h"

namespace mesher::progressive {

inline constexpr std::size_t kPmMostLayers = 255;
/// Returns whether a layer may have this name: 1 to 256 bytes, and not that of the positions, which
/// other formats keep among the attributes.
inline bool is_layer_name(std::string_view name) {
  constexpr std::size_t kMost = 256;
  return !name.empty() && name.size() <= kMost && name != "POSITION";
}

/// Layers and groups of a file, which precede the values.
struct AttributeTable {
  std::vector<LayerFormat> layers;
  bool has_face_groups = false;
  std::vector<FaceGroup> groups;

  /// Returns the size of the values of one wedge in bytes.
  std::uint64_t wedge_bytes() const {
    std::uint64_t sum = 0;
    for (const LayerFormat& layer : layers)
      sum += layer.type.value_bytes();
    return sum;
  }
};

/// Returns the table as bytes (docs/pm-format.md).
Array<std::byte> encode_table(const AttributeTable& table);
/// Reads a table. Returns what is wrong, or an empty string. O(bytes).
std::string_view decode_table(std::span<const std::byte> bytes, AttributeTable& table);

}  // namespace mesher::progressive
