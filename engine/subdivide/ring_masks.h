#pragma once

#include <array>
#include <cstdint>

#include "engine/subdivide/masks.h"

namespace mesher::subdivide {

/// Loop's masks as floats, precomputed for common valences.
class RingMasks {
 public:
  struct Weights {
    float own = 1.0F;
    float each = 0.0F;
  };
  using Mask = RingMask (*)(std::uint32_t valence);

  explicit RingMasks(Mask mask) : mask_(mask) {
    for (std::uint32_t n = 3; n < kCommon; ++n)
      common_[n] = rounded(mask(n));
  }
  /// Returns the weights for a valence. With fewer than 3 neighbors, the vertex keeps its position.
  Weights operator()(std::uint32_t valence) const {
    return valence < kCommon ? common_[valence] : rounded(mask_(valence));
  }

 private:
  static constexpr std::uint32_t kCommon = 32;
  static Weights rounded(const RingMask& mask) {
    return {static_cast<float>(mask.own), static_cast<float>(mask.each)};
  }
  Mask mask_;
  std::array<Weights, kCommon> common_{};
};

}  // namespace mesher::subdivide
