#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/ids.h"
#include "engine/progressive/progressive_attributes.h"

namespace mesher::progressive {

/// The attributes of a base mesh, in the numbering of ProgressiveAttributes.
struct BaseAttributes {
  Array<Wedge> corner_wedge;             ///< 3 per face; empty if there are no layers
  std::vector<AttributeLayer> layers;    ///< per wedge
  std::vector<std::uint8_t> is_faceted;  ///< by layer
  Array<std::uint32_t> group;            ///< per face; empty if there are no groups
  std::vector<FaceGroup> groups;
};

/// What a split does to attributes. New wedges get the next unused ids.
struct NewSplitAttributes {
  std::vector<CornerChange> corner_changes;    ///< corner, and its wedge after the split
  std::vector<Wedge> corners;                  ///< of the new faces
  std::vector<std::uint32_t> group;            ///< of the new faces
  std::vector<Wedge> changed;                  ///< wedges that get other values
  std::vector<AttributeLayer> new_values;      ///< per new wedge
  std::vector<AttributeLayer> changed_values;  ///< per changed wedge

  /// Empties the lists, and gives the layers these types.
  void clear(std::span<const AttributeLayer> types);
};

/// Builds the attributes of a progressive mesh split by split.
class AttributeAppender {
 public:
  /// Pre: `to` outlives this.
  explicit AttributeAppender(ProgressiveAttributes& to) : to_(to) {}

  /// Makes the attributes those of a base, without splits.
  void start(BaseAttributes&& base);
  /// Reserves memory for this many splits in total. Throws std::bad_alloc.
  void reserve(std::uint32_t splits);
  /// Appends a split and moves to it. O(size of the split). Throws std::bad_alloc; the attributes
  /// are unchanged then. Pre: the result fulfills W1 to W4, and level() == split_count().
  void append(const NewSplitAttributes& split);

 private:
  ProgressiveAttributes& to_;
};

}  // namespace mesher::progressive
