#pragma once

#include "engine/progressive/codec/attribute_table.h"
#include "engine/progressive/progressive_attributes.h"

namespace mesher::progressive {

/// Bits per component to which floats of attributes are rounded; 0: they are not. Integers and
/// attributes whose meaning is unknown are never rounded.
struct AttributeRounding {
  unsigned texcoord = 12;
  unsigned normal = 10;  ///< of two octahedral coordinates
  unsigned tangent = 10;
  unsigned color = 8;
  unsigned weights = 8;
  unsigned delta = 12;
};

/// Returns the table of a file with these attributes. Without `rounding`, all values are exact. A
/// layer with values that are not finite, and normals without unit length, stay exact.
AttributeTable make_table(const ProgressiveAttributes& attributes,
                          const AttributeRounding* rounding);

}  // namespace mesher::progressive
