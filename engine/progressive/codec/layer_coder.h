#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/progressive/codec/layer_format.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/range_coder.h"

namespace mesher::progressive {

/// What a value is expected to be.
struct PredictedValue {
  RawValue mean{};
  RawValue variance{};                ///< of each component
  std::span<const std::byte> source;  ///< the value before the split, or that of a neighbor
  std::span<const std::byte> mate;    ///< of another corner of the same new face, or empty
};

/// What a value belongs to. Each has models of its own.
enum class ValueRole : std::uint8_t { child, changed, other };

/// Codes the values of a layer: equal to a known value, or else the difference from a prediction.
/// How well the values around fit the prediction says how large the difference may be.
class LayerCoder {
 public:
  explicit LayerCoder(const LayerFormat& format) : format_(format) {}

  /// Codes `actual` (ignored by a decoder) into `to`. Returns false if there is no such value.
  template <class Coder>
  bool code(Coder& coder, ValueRole role, const PredictedValue& predicted,
            std::span<const std::byte> actual, std::span<std::byte> to) {
    Role& models = roles_[static_cast<std::size_t>(role)];
    ValueNumbers numbers{};
    if constexpr (!Coder::kDecodes) numbers = numbers_of(format_, actual);
    const std::size_t before = models.last;
    models.last = 0;
    if (coder.bit(models.is_source[before], is_same(coder, numbers, predicted.source))) {
      models.last = 1;
      std::ranges::copy(predicted.source, to.begin());
      return true;
    }
    if (!predicted.mate.empty() &&
        coder.bit(models.is_mate[before], is_same(coder, numbers, predicted.mate))) {
      models.last = 2;
      std::ranges::copy(predicted.mate, to.begin());
      return true;
    }
    if (format_.rounding != Rounding::none) {
      code_rounded(coder, models, predicted, numbers);
    } else {
      code_exact(coder, models, predicted, numbers);
    }
    return set_value(format_, numbers, to);
  }

  /// Codes a value of the base as the difference from another value, or from 0 if there is none.
  template <class Coder>
  bool code_base(Coder& coder, std::span<const std::byte> near, std::span<const std::byte> actual,
                 std::span<std::byte> to) {
    ValueNumbers numbers{};
    if constexpr (!Coder::kDecodes) numbers = numbers_of(format_, actual);
    const ValueNumbers from = near.empty() ? ValueNumbers{} : numbers_of(format_, near);
    for (std::size_t c = 0; c < format_.number_count(); ++c)
      numbers[c] = from[c] + base_[c].code(coder, numbers[c] - from[c]);
    return set_value(format_, numbers, to);
  }

 private:
  static constexpr int kSpreads = 40;

  struct Role {
    std::array<AdaptiveBitModel, 3> is_source;
    std::array<AdaptiveBitModel, 3> is_mate;
    std::array<SignedIntegerCoder, kSpreads> difference;
    SignedIntegerCoder derived;  ///< of the component that follows from unit length
    std::size_t last = 0;        ///< how the last value was coded
  };

  template <class Coder>
  bool is_same(const Coder&, const ValueNumbers& numbers, std::span<const std::byte> value) const {
    if constexpr (Coder::kDecodes) {
      return false;
    } else {
      return numbers == numbers_of(format_, value);
    }
  }

  static int exponent(double value) {
    return static_cast<int>(std::bit_cast<std::uint64_t>(value) >> 52U & 0x7FFU);
  }
  /// Returns the context of a difference whose square is probably 2^exponent.
  static std::size_t spread(int exponent) {
    return static_cast<std::size_t>(std::clamp((exponent >> 1) + 8, 0, kSpreads - 1));
  }

  template <class Coder>
  void code_rounded(Coder& coder, Role& models, const PredictedValue& predicted,
                    ValueNumbers& numbers) {
    const ValueNumbers from =
        nearest_numbers(format_, predicted.mean, raw_value(format_.type, predicted.source));
    for (std::size_t c = 0; c < format_.number_count(); ++c) {
      double variance = predicted.variance[c];
      if (format_.rounding == Rounding::octahedral) {
        const double unit = 1.0 / static_cast<double>(1U << (format_.bits - 1));
        variance = (predicted.variance[0] + predicted.variance[1] + predicted.variance[2]) /
                   (2.0 * unit * unit);
      } else {
        variance /= format_.step[c] * format_.step[c];
      }
      SignedIntegerCoder& model = models.difference[spread(exponent(variance) - 1023)];
      numbers[c] = from[c] + model.code(coder, numbers[c] - from[c]);
    }
  }

  template <class Coder>
  void code_exact(Coder& coder, Role& models, const PredictedValue& predicted,
                  ValueNumbers& numbers) {
    const RawValue source = raw_value(format_.type, predicted.source);
    const std::array<std::size_t, 4> order = component_order(predicted.mean);
    RawValue known{};
    for (std::size_t step = 0; step < format_.type.components; ++step) {
      const std::size_t c = order[step];
      const bool is_derived = format_.is_unit && step == 2;
      double mean = predicted.mean[c];
      if (is_derived) {
        const double left =
            1.0 - known[order[0]] * known[order[0]] - known[order[1]] * known[order[1]];
        const double length = left > 0.0 ? std::sqrt(left) : 0.0;
        mean = mean < 0.0 ? -length : length;
      }
      const std::int64_t from = nearest_number(format_, mean, source[c]);
      SignedIntegerCoder& model =
          is_derived ? models.derived
                     : models.difference[exact_spread(predicted.variance[c], mean)];
      numbers[c] = from + model.code(coder, numbers[c] - from);
      known[c] = known_component(numbers[c]);
    }
  }

  /// Floats have neighbors at distances that depend on their size.
  std::size_t exact_spread(double variance, double mean) const {
    const int square = exponent(variance);
    if (format_.type.component != ComponentType::f32) return spread(square - 1023);
    return spread(square + 1069 - 2 * std::max(exponent(mean), 897));
  }

  double known_component(std::int64_t number) const {
    const bool is_float = format_.type.component == ComponentType::f32;
    const bool is_held = number >= INT32_MIN && number <= INT32_MAX;
    return is_float && is_held ? double{pm_float(static_cast<std::int32_t>(number))} : 0.0;
  }

  /// Of a unit vector, the largest component is coded third: it follows best from the others.
  std::array<std::size_t, 4> component_order(const RawValue& mean) const {
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    if (!format_.is_unit) return order;
    std::size_t largest = 0;
    for (std::size_t c = 1; c < 3; ++c) {
      if (std::abs(mean[c]) > std::abs(mean[largest])) largest = c;
    }
    return {(largest + 1) % 3, (largest + 2) % 3, largest, 3};
  }

  LayerFormat format_;
  std::array<Role, 3> roles_;
  std::array<SignedIntegerCoder, 4> base_;
};

}  // namespace mesher::progressive
