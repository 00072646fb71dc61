#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/core/array.h"

namespace mesher {

// An adaptive binary range coder (G. Martin, "Range encoding", 1979) as docs/pm-format.md says. Its
// interval has 64 bits and gives up 32 at a time. Encoder and decoder have the same functions, so
// that a model is written once for both: a function takes the value and returns it; the decoder
// does not look at what it is given.

/// How likely a bit is to be 0, of 65536: the mean of two estimates, one that adapts fast and one
/// that adapts slowly.
class BitModel {
 public:
  std::uint32_t zero() const { return (std::uint32_t{fast_} + slow_) >> 1U; }
  void update(bool bit) {
    if (bit) {
      fast_ = static_cast<std::uint16_t>(fast_ - (fast_ >> kFast));
      slow_ = static_cast<std::uint16_t>(slow_ - (slow_ >> kSlow));
    } else {
      fast_ = static_cast<std::uint16_t>(fast_ + ((0xFFFFU - fast_) >> kFast));
      slow_ = static_cast<std::uint16_t>(slow_ + ((0xFFFFU - slow_) >> kSlow));
    }
  }

 private:
  static constexpr unsigned kFast = 4;
  static constexpr unsigned kSlow = 7;
  std::uint16_t fast_ = 0x8000;
  std::uint16_t slow_ = 0x8000;
};

/// Writes into memory; one block at a time.
class RangeEncoder {
 public:
  static constexpr bool kDecodes = false;

  bool bit(BitModel& model, bool value) {
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
  /// A number below `n`, all equally likely. Pre: n > 0.
  std::uint32_t uniform(std::uint32_t value, std::uint32_t n) {
    range_ /= n;
    add(range_ * value);
    normalize();
    return value;
  }
  /// The low `count` bits of a number. Pre: count <= 32.
  std::uint32_t bits(std::uint32_t value, unsigned count) {
    range_ >>= count;
    add(range_ * value);
    normalize();
    return value;
  }
  /// Ends the block and returns its bytes; the next call of any function begins another.
  Array<std::byte> finish();

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
  /// The highest bytes of low.
  void put(unsigned count);

  std::uint64_t low_ = 0;
  std::uint64_t range_ = ~std::uint64_t{0};
  Array<std::byte> bytes_;
};

/// Reads a block; past its end come zeros. Any bytes decode to something in range.
class RangeDecoder {
 public:
  static constexpr bool kDecodes = true;

  explicit RangeDecoder(std::span<const std::byte> bytes)
      : next_(bytes.data()), end_(bytes.data() + bytes.size()) {
    code_ = std::uint64_t{word()} << 32U;
    code_ |= word();
  }

  bool bit(BitModel& model, bool = false) {
    const std::uint64_t bound = (range_ >> 16U) * model.zero();
    const bool value = code_ >= bound;
    if (value) {
      code_ -= bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    model.update(value);
    normalize();
    return value;
  }
  std::uint32_t uniform(std::uint32_t, std::uint32_t n) {
    range_ /= n;
    return take(n - 1);
  }
  std::uint32_t bits(std::uint32_t, unsigned count) {
    range_ >>= count;
    return take(static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1));
  }

 private:
  std::uint32_t take(std::uint32_t highest) {
    const std::uint64_t quotient = code_ / range_;
    const auto value = static_cast<std::uint32_t>(quotient < highest ? quotient : highest);
    code_ -= range_ * value;
    // A block that no encoder wrote may leave more than the interval holds.
    if (code_ >= range_) code_ = range_ - 1;
    normalize();
    return value;
  }
  void normalize() {
    if (range_ >> 32U != 0) return;
    code_ = code_ << 32U | word();
    range_ <<= 32U;
  }
  /// Four bytes, the first the highest.
  std::uint32_t word();

  std::uint64_t code_ = 0;
  std::uint64_t range_ = ~std::uint64_t{0};
  const std::byte* next_;
  const std::byte* end_;
};

inline std::uint32_t RangeDecoder::word() {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < 4; ++i)
    value = value << 8U | (next_ != end_ ? std::to_integer<std::uint32_t>(*next_++) : 0U);
  return value;
}

/// A number of `kBits` bits, from the highest on, each bit with a model for what came before it.
template <unsigned kBits>
class BitTree {
 public:
  template <class Coder>
  std::uint32_t code(Coder& coder, std::uint32_t value) {
    std::uint32_t node = 1;
    for (unsigned i = kBits; i-- > 0;)
      node = node << 1U | std::uint32_t{coder.bit(models_[node], (value >> i & 1U) != 0)};
    return node - (1U << kBits);
  }

 private:
  BitModel models_[1U << kBits];
};

/// A number of up to 63 bits: how many bits it has by a tree, then the two bits after the leading
/// one by models, then the rest as it is.
template <unsigned kTreeBits>
class MagnitudeModel {
 public:
  static constexpr unsigned kMostBits = (1U << kTreeBits) - 1;

  template <class Coder>
  std::uint64_t code(Coder& coder, std::uint64_t value) {
    const auto width = length_.code(coder, static_cast<std::uint32_t>(std::bit_width(value)));
    if (width <= 1) return width;
    std::uint64_t result = 1;
    unsigned left = width - 1;
    const auto next = [&] { return (value >> (left - 1) & 1U) != 0; };
    const bool second = coder.bit(second_[width], left > 0 && next());
    result = result << 1U | std::uint64_t{second};
    if (--left == 0) return result;
    const bool third = coder.bit(third_[2 * width + std::size_t{second}], next());
    result = result << 1U | std::uint64_t{third};
    --left;
    while (left > 0) {
      const unsigned count = left < 24 ? left : 24;
      left -= count;
      const std::uint32_t mask = (1U << count) - 1;
      const auto part = static_cast<std::uint32_t>(value >> left) & mask;
      result = result << count | coder.bits(part, count);
    }
    return result;
  }

 private:
  BitTree<kTreeBits> length_;
  BitModel second_[1U << kTreeBits];
  BitModel third_[2U << kTreeBits];
};

/// A number with a sign, less than 2^40 from 0: what only a hostile file says is cut off there.
template <unsigned kTreeBits>
class SignedModel {
 public:
  template <class Coder>
  std::int64_t code(Coder& coder, std::int64_t value) {
    constexpr std::uint64_t most = (std::uint64_t{1} << 40U) - 1;
    const auto told =
        magnitude_.code(coder, static_cast<std::uint64_t>(value < 0 ? -value : value));
    const std::uint64_t size = told < most ? told : most;
    if (size == 0) return 0;
    const bool is_negative = coder.bit(sign_, value < 0);
    return is_negative ? -static_cast<std::int64_t>(size) : static_cast<std::int64_t>(size);
  }

 private:
  MagnitudeModel<kTreeBits> magnitude_;
  BitModel sign_;
};

}  // namespace mesher
