// Values of attribute layers, in any type of component. Include after view.glsl.
#include "shared/look.h"

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer Surface {
  SurfaceBlock at;
};

// ComponentType in engine/mesh/attributes.h.
const uint kS8 = 0;
const uint kU8 = 1;
const uint kS16 = 2;
const uint kU16 = 3;
const uint kU32 = 4;

// Returns a component of a value that starts at a byte. Components are aligned to their size, so
// that none crosses a word.
float component_at(LayerConstants layer, uint byte) {
  const uint type = (layer.format >> 3) & 7;
  const bool is_fraction = (layer.format & 64) != 0;
  const uint word = Uints(layer.values).at[byte >> 2];
  const int shift = 8 * int(byte & 3);
  switch (type) {
    case kS8: {
      const float value = float(bitfieldExtract(int(word), shift, 8));
      return is_fraction ? max(value / 127.0, -1.0) : value;
    }
    case kU8: {
      const float value = float(bitfieldExtract(word, shift, 8));
      return is_fraction ? value / 255.0 : value;
    }
    case kS16: {
      const float value = float(bitfieldExtract(int(word), shift, 16));
      return is_fraction ? max(value / 32767.0, -1.0) : value;
    }
    case kU16: {
      const float value = float(bitfieldExtract(word, shift, 16));
      return is_fraction ? value / 65535.0 : value;
    }
    case kU32: {
      return is_fraction ? float(word) / 4294967295.0 : float(word);
    }
  }
  return uintBitsToFloat(word);
}

bool has_layer(LayerConstants layer) { return layer.format != 0; }

// Returns a value of a layer. Components that its type lacks keep those of `absent`, and so do all
// of a value that is not a number: that of a corner without one.
vec4 fetch_value(LayerConstants layer, uint wedge, vec4 absent) {
  const uint components = layer.format & 7;
  const uint component_bytes = layer.stride / max(components, 1u);
  vec4 value = absent;
  for (uint c = 0; c < components; ++c)
    value[c] = component_at(layer, wedge * layer.stride + c * component_bytes);
  return any(isnan(value)) ? absent : value;
}
