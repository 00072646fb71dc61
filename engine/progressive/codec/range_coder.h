#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "engine/core/array.h"

namespace mesher::progressive {

// An adaptive binary range coder (G. Martin, "Range encoding", 1979) as specified by
// docs/pm-format.md. Its interval has 64 bits and is shifted by 32 at a time. Encoder and decoder
// have the same functions, so a model is written once for both: each function takes the value and
// returns it; the decoder ignores the value passed.

/// Adaptive probability that a bit is 0, in units of 1/65536: the mean of a fast and a slow
/// estimate. Neither comes closer than 31 to 0 or 65536. Branch-free, because the bits are
/// unpredictable.
class AdaptiveBitModel {
 public:
  std::uint32_t zero() const { return static_cast<std::uint32_t>(fast_ + slow_) >> 1U; }
  void update(bool bit) {
    const int goal = bit ? 31 : 65505;
    fast_ = static_cast<std::uint16_t>(fast_ + ((goal - fast_) >> 4));
    slow_ = static_cast<std::uint16_t>(slow_ + ((goal - slow_) >> 7));
  }

 private:
  std::uint16_t fast_ = 0x8000;
  std::uint16_t slow_ = 0x8000;
};

/// Encodes into memory, one block at a time.
class RangeEncoder {
 public:
  static constexpr bool kDecodes = false;

  bool bit(AdaptiveBitModel& model, bool value) {
    const std::uint64_t bound = (range_ >> 16U) * model.zero();
    if (value) {
      add(bound);
      range_ -= bound;
    } else {
      range_ = bound;
    }
    model.update(value);
    normalize();
    return value;
  }
  /// Codes a number below `n`, all equally likely. Pre: n > 0.
  std::uint32_t uniform(std::uint32_t value, std::uint32_t n) {
    range_ /= n;
    add(range_ * value);
    normalize();
    return value;
  }
  /// Codes a number of `count` equiprobable bits. These raw bits are stored apart from the coded
  /// ones. Pre: count <= 32.
  std::uint32_t bits(std::uint32_t value, unsigned count) {
    plain_ |= std::uint64_t{value} << plain_count_;
    plain_count_ += count;
    for (; plain_count_ >= 8; plain_count_ -= 8, plain_ >>= 8U)
      plain_bytes_.push_back(static_cast<std::byte>(plain_));
    return value;
  }
  /// Returns the information in the block so far, in bits.
  double bits_so_far() const {
    return 8.0 * static_cast<double>(bytes_.size() + plain_bytes_.size()) + plain_count_ + 64.0 -
           std::log2(static_cast<double>(range_));
  }
  /// Ends the block and returns its bytes, padded to at least `least`. The next call of any
  /// function begins a new block.
  Array<std::byte> finish(std::uint64_t least);

 private:
  void add(std::uint64_t amount) {
    low_ += amount;
    if (low_ < amount) carry();
  }
  void carry();
  void normalize() {
    if (range_ >> 32U != 0) return;
    put(4);
    low_ <<= 32U;
    range_ <<= 32U;
  }
  /// Writes the highest bytes of low.
  void put(unsigned count);

  std::uint64_t low_ = 0;
  std::uint64_t range_ = ~std::uint64_t{0};
  Array<std::byte> bytes_;
  std::uint64_t plain_ = 0;  ///< fewer than 8 bits, not written yet
  unsigned plain_count_ = 0;
  Array<std::byte> plain_bytes_;
};

/// Decodes a block; reads zeros past its ends. Any bytes decode to values in range.
class RangeDecoder {
 public:
  static constexpr bool kDecodes = true;

  explicit RangeDecoder(std::span<const std::byte> bytes)
      : begin_(bytes.data()), end_(bytes.data() + bytes.size()), next_(begin_), plain_next_(end_) {
    code_ = std::uint64_t{word()} << 32U;
    code_ |= word();
  }

  bool bit(AdaptiveBitModel& model, bool = false) {
    const std::uint64_t bound = (range_ >> 16U) * model.zero();
    const bool value = code_ >= bound;
    // Branch-free as in AdaptiveBitModel: a mask of all ones or all zeros.
    const std::uint64_t ones = -std::uint64_t{value};
    code_ -= bound & ones;
    range_ = bound + ((range_ - 2 * bound) & ones);
    model.update(value);
    normalize();
    return value;
  }
  std::uint32_t uniform(std::uint32_t, std::uint32_t n) {
    range_ /= n;
    return take(n - 1);
  }
  std::uint32_t bits(std::uint32_t, unsigned count) {
    if (plain_count_ < count) fill();
    const std::uint64_t mask = (std::uint64_t{1} << count) - 1;
    const auto value = static_cast<std::uint32_t>(plain_ & mask);
    plain_ >>= count;
    plain_count_ -= count;
    return value;
  }

 private:
  std::uint32_t take(std::uint32_t highest) {
    const std::uint64_t quotient = code_ / range_;
    const auto value = static_cast<std::uint32_t>(quotient < highest ? quotient : highest);
    code_ -= range_ * value;
    // A block not written by the encoder may leave more than the interval holds.
    if (code_ >= range_) code_ = range_ - 1;
    normalize();
    return value;
  }
  /// Reads four more bytes of raw bits, from the end of the block backward.
  void fill() {
    if (plain_next_ - begin_ >= 4) {
      plain_next_ -= 4;
      std::uint32_t four = 0;
      std::memcpy(&four, plain_next_, 4);
      plain_ |= std::uint64_t{__builtin_bswap32(four)} << plain_count_;
    } else {
      for (unsigned i = 0; i < 32 && plain_next_ != begin_; i += 8)
        plain_ |= std::to_integer<std::uint64_t>(*--plain_next_) << (plain_count_ + i);
    }
    plain_count_ += 32;
  }
  void normalize() {
    if (range_ >> 32U != 0) return;
    code_ = code_ << 32U | word();
    range_ <<= 32U;
  }
  /// Reads four bytes, most significant first.
  std::uint32_t word();

  std::uint64_t code_ = 0;
  std::uint64_t range_ = ~std::uint64_t{0};
  std::uint64_t plain_ = 0;
  unsigned plain_count_ = 0;
  const std::byte* begin_;
  const std::byte* end_;
  const std::byte* next_;
  const std::byte* plain_next_;
};

inline std::uint32_t RangeDecoder::word() {
  std::uint32_t value = 0;
  if (end_ - next_ >= 4) {
    std::memcpy(&value, next_, 4);
    next_ += 4;
    return __builtin_bswap32(value);
  }
  for (unsigned i = 0; i < 4; ++i)
    value = value << 8U | (next_ != end_ ? std::to_integer<std::uint32_t>(*next_++) : 0U);
  return value;
}

/// Models a number of `kBits` bits, from the highest on; each bit has a model per prefix.
template <unsigned kBits>
class BitTreeModel {
 public:
  template <class Coder>
  std::uint32_t code(Coder& coder, std::uint32_t value) {
    std::uint32_t node = 1;
    for (unsigned i = kBits; i-- > 0;)
      node = node << 1U | std::uint32_t{coder.bit(models_[node], (value >> i & 1U) != 0)};
    return node - (1U << kBits);
  }

 private:
  AdaptiveBitModel models_[1U << kBits];
};

/// Models a signed integer of known bit width, below 2^40 in magnitude: larger values, which only
/// hostile files contain, are clamped. The bit after the leading one is modeled; the other bits are
/// raw, and the sign comes last. The caller codes the bit width, `width`.
class MagnitudeBitsCoder {
 public:
  template <class Coder>
  std::int64_t code(Coder& coder, unsigned width, std::int64_t value) {
    constexpr std::uint64_t most = (std::uint64_t{1} << 40U) - 1;
    if (width == 0) return 0;
    const auto magnitude = static_cast<std::uint64_t>(value < 0 ? -value : value);
    std::uint64_t size = 1;
    unsigned left = width - 1;
    if (left > 0 && width <= kMostLearned) {
      --left;
      size = 2 | std::uint64_t{coder.bit(second_[width], (magnitude >> left & 1U) != 0)};
    }
    for (; left > 24; left -= 24)
      size = size << 24U | coder.bits(low_bits(magnitude >> (left - 24), 24), 24);
    const std::uint32_t last = low_bits(magnitude, left) << 1U | (value < 0 ? 1U : 0U);
    const std::uint32_t rest = coder.bits(last, left + 1);
    size = std::min(size << left | rest >> 1U, most);
    return (rest & 1U) != 0 ? -static_cast<std::int64_t>(size) : static_cast<std::int64_t>(size);
  }

  static unsigned width(std::int64_t value) {
    return static_cast<unsigned>(
        std::bit_width(static_cast<std::uint64_t>(value < 0 ? -value : value)));
  }

 private:
  static std::uint32_t low_bits(std::uint64_t value, unsigned count) {
    return static_cast<std::uint32_t>(value) & ((1U << count) - 1);
  }

  // The second bit of longer numbers is nearly uniform, so modeling it does not pay.
  static constexpr unsigned kMostLearned = 8;

  AdaptiveBitModel second_[kMostLearned + 1];
};

/// Models a signed integer of unknown bit width.
class SignedIntegerCoder {
 public:
  template <class Coder>
  std::int64_t code(Coder& coder, std::int64_t value) {
    return digits_.code(coder, width_.code(coder, MagnitudeBitsCoder::width(value)), value);
  }

 private:
  BitTreeModel<6> width_;
  MagnitudeBitsCoder digits_;
};

/// Models a signed integer whose bit width is probably one of the seven from `lowest` on.
class HintedIntegerCoder {
 public:
  template <class Coder>
  std::int64_t code(Coder& coder, unsigned lowest, std::int64_t value) {
    unsigned width = MagnitudeBitsCoder::width(value);
    unsigned near = width - lowest;
    near = near_.code(coder, near < kNear ? near : kNear);
    width = near < kNear ? lowest + near : far_.code(coder, width);
    return digits_.code(coder, width, value);
  }

 private:
  static constexpr unsigned kNear = 7;

  BitTreeModel<3> near_;
  BitTreeModel<6> far_;
  MagnitudeBitsCoder digits_;
};

}  // namespace mesher::progressive
