#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/progress.h"
#include "engine/progressive/codec/attribute_rounding.h"
#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// Receives the bytes of a file in order, some at a time.
using ByteSink = std::function<void(std::span<const std::byte>)>;

struct PmWriteOptions {
  /// 0: lossless floats. 4 to 24: all positions are rounded to a grid with this many bits along the
  /// longest side of the bounding box of all levels.
  unsigned coordinate_bits = 0;
  /// Attributes of the mesh, or null. If positions are rounded, so are the floats of attributes.
  ProgressiveAttributes* attributes = nullptr;
  AttributeRounding rounding{};
  /// Bytes that the file holds beside the attributes, such as materials. Not interpreted.
  std::span<const std::byte> appendix{};
  Progress* progress = nullptr;
};

/// Size of the values of a layer.
struct PmLayerSize {
  std::string name;
  unsigned bits = 0;  ///< per number that a value was rounded to; 0: exact
  std::uint64_t bytes = 0;
};

/// Sizes of the written parts in bytes. Those of layers are rounded: they share payloads.
struct PmSizes {
  std::uint64_t total = 0;
  std::uint64_t base = 0;    ///< header and base mesh
  std::uint64_t splits = 0;  ///< blocks of splits
  /// Parts of the above that a file without attributes would not have: headers and all below.
  std::uint64_t attributes = 0;
  std::uint64_t wedges = 0;    ///< which corners share values
  std::uint64_t groups = 0;    ///< the groups of faces, without their names
  std::uint64_t appendix = 0;  ///< PmWriteOptions::appendix
  std::vector<PmLayerSize> layers;

  /// Returns the size of the mesh alone.
  std::uint64_t geometry() const { return total - attributes; }
};

/// Writes a progressive mesh in the format of docs/pm-format.md: header, base mesh, then blocks of
/// splits with checksums, small blocks first. Any prefix of whole blocks yields a mesh. With
/// attributes or an appendix, the file has version 2; otherwise it has version 1. Leaves `mesh` and
/// the attributes at their level. The same mesh and options yield the same bytes. O(F). Throws
/// Cancelled, anything that the sink throws, and OutputError if the format cannot represent the
/// mesh.
PmSizes write_pm(ProgressiveMesh& mesh, const PmWriteOptions& options, const ByteSink& sink);

}  // namespace mesher::progressive
