#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/codec/split_ring.h"

namespace mesher::progressive {

/// Models which edges at the parent open. Going around, it codes one bit per slot: cut or not.
/// Short edges open more often than long ones, and the two cuts are seldom adjacent.
class CutCoder {
 public:
  template <class Coder>
  SplitCut code(Coder& coder, const SplitRing& ring, const SplitCut& cut) {
    const std::uint32_t slots = ring.slots();
    const bool is_pair = ring.is_closed() || coder.bit(is_pair_, cut.right != kNone);
    if (!is_pair) return {coder.uniform(cut.left, slots), kNone};
    if (slots > kFewSlots) {
      const std::uint32_t left = coder.uniform(cut.left, slots);
      return {left, coder.uniform(cut.right, slots)};
    }
    measure(ring);
    return code_pair(coder, ring, cut);
  }

 private:
  static constexpr std::uint32_t kFewSlots = 16;  ///< rings of more slots are not modeled
  static constexpr std::uint32_t kLengths = 7;

  /// Classifies the edges by squared length.
  void measure(const SplitRing& ring) {
    double sum = 0.0;
    const std::uint32_t slots = ring.slots();
    for (std::uint32_t i = 0; i < slots; ++i) {
      square_[i] = dot(ring.offset(i), ring.offset(i));
      sum += square_[i];
    }
    const double mean = sum / slots;
    for (std::uint32_t i = 0; i < slots; ++i) {
      length_[i] = 0;
      for (const double limit : {0.375, 0.5625, 0.8125, 1.125, 1.5, 2.25})
        length_[i] += square_[i] > limit * mean ? 1U : 0U;
    }
  }

  template <class Coder>
  SplitCut code_pair(Coder& coder, const SplitRing& ring, const SplitCut& cut) {
    const std::uint32_t slots = ring.slots();
    const std::uint32_t lower = std::min(cut.left, cut.right);
    const std::uint32_t upper = std::max(cut.left, cut.right);
    std::uint32_t first = 0;
    while (first + 2 < slots && !coder.bit(first_[slots - first][length_[first]], first == lower))
      ++first;
    std::uint32_t second = first + 1;
    while (second + 1 < slots &&
           !coder.bit(second_[slots - second][std::min(second - first, kFarthest)][length_[second]],
                      second == upper))
      ++second;
    const std::uint32_t inner = 2 * (second - first);
    const std::size_t shape = inner < slots ? 0 : inner == slots ? 1 : 2;
    const bool is_turned =
        coder.bit(is_turned_[2 * shape + (ring.is_closed() ? 0 : 1)], cut.left > cut.right);
    return is_turned ? SplitCut{second, first} : SplitCut{first, second};
  }

  static constexpr std::uint32_t kFarthest = 10;

  std::array<double, kFewSlots> square_{};         ///< squared lengths of the current ring
  std::array<std::uint32_t, kFewSlots> length_{};  ///< length classes of the current ring
  AdaptiveBitModel is_pair_;
  AdaptiveBitModel first_[kFewSlots + 1][kLengths];
  AdaptiveBitModel second_[kFewSlots + 1][kFarthest + 1][kLengths];
  AdaptiveBitModel is_turned_[6];
};

}  // namespace mesher::progressive
