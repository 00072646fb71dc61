#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/mesh/mesh.h"
#include "engine/progressive/codec/range_coder.h"

namespace mesher::progressive {

/// Models a sharpness: 0, infinity, or the bits of a float.
class SharpnessCoder {
 public:
  /// A decoded value may be invalid: see is_sharpness.
  template <class Coder>
  float code(Coder& coder, float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    if (!coder.bit(is_sharp_, bits != 0)) return 0.0F;
    if (coder.bit(is_infinite_, value == kInfinitelySharp)) return kInfinitelySharp;
    return std::bit_cast<float>(coder.bits(bits, 32));
  }

 private:
  AdaptiveBitModel is_sharp_;
  AdaptiveBitModel is_infinite_;
};

inline bool is_sharpness(float value) {
  return value >= 0.0F;
}

inline bool has_same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

}  // namespace mesher::progressive
