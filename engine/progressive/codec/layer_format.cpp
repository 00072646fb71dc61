#include "engine/progressive/codec/layer_format.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/mesh/component.h"
#include "engine/progressive/codec/pm_format.h"

namespace mesher::progressive {
namespace {

/// Returns the nearest integer in [0, most], rounding halves up; 0 for NaN.
std::int64_t nearest_in(double value, std::int64_t most) {
  if (!(value > 0.0)) return 0;
  if (value >= static_cast<double>(most)) return most;
  return static_cast<std::int64_t>(std::floor(value + 0.5));
}

std::int64_t grid_most(const LayerFormat& format) {
  return (std::int64_t{1} << format.bits) - 1;
}
/// Returns the number of an octahedral coordinate 0. It is an integer, so axes are exact.
std::int64_t octahedral_half(const LayerFormat& format) {
  return (std::int64_t{1} << (format.bits - 1)) - 1;
}

double sign_of(double value) {
  return value < 0.0 ? -1.0 : 1.0;
}

ValueNumbers octahedral_numbers(const LayerFormat& format, const RawValue& v) {
  const double sum = std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
  double x = v[0] / sum;
  double y = v[1] / sum;
  if (v[2] < 0.0) {
    const double folded = (1.0 - std::abs(y)) * sign_of(x);
    y = (1.0 - std::abs(x)) * sign_of(y);
    x = folded;
  }
  const std::int64_t half = octahedral_half(format);
  const auto scale = static_cast<double>(half);
  return {nearest_in((x + 1.0) * scale, 2 * half), nearest_in((y + 1.0) * scale, 2 * half), 0, 0};
}

std::array<float, 3> octahedral_value(const LayerFormat& format, const ValueNumbers& numbers) {
  const auto scale = static_cast<double>(octahedral_half(format));
  double x = static_cast<double>(numbers[0]) / scale - 1.0;
  double y = static_cast<double>(numbers[1]) / scale - 1.0;
  const double z = 1.0 - std::abs(x) - std::abs(y);
  if (z < 0.0) {
    const double unfolded = (1.0 - std::abs(y)) * sign_of(x);
    y = (1.0 - std::abs(x)) * sign_of(y);
    x = unfolded;
  }
  const double length = std::sqrt(x * x + y * y + z * z);
  return {static_cast<float>(x / length), static_cast<float>(y / length),
          static_cast<float>(z / length)};
}

ValueNumbers rounded_numbers(const LayerFormat& format, const RawValue& value) {
  if (format.rounding == Rounding::octahedral) return octahedral_numbers(format, value);
  ValueNumbers numbers{};
  for (std::size_t c = 0; c < format.type.components; ++c)
    numbers[c] = nearest_in((value[c] - format.origin[c]) / format.step[c], grid_most(format));
  return numbers;
}

}  // namespace

RawValue raw_value(const AttributeType& type, std::span<const std::byte> value) {
  return with_component(type.component, [&]<class T>(T*) {
    T components[AttributeType::kMostComponents] = {};
    std::memcpy(components, value.data(), type.value_bytes());
    RawValue raw{};
    for (std::size_t c = 0; c < type.components; ++c)
      raw[c] = static_cast<double>(components[c]);
    return raw;
  });
}

ValueNumbers numbers_of(const LayerFormat& format, std::span<const std::byte> value) {
  if (format.rounding != Rounding::none)
    return rounded_numbers(format, raw_value(format.type, value));
  return with_component(format.type.component, [&]<class T>(T*) {
    T components[AttributeType::kMostComponents] = {};
    std::memcpy(components, value.data(), format.type.value_bytes());
    ValueNumbers numbers{};
    for (std::size_t c = 0; c < format.type.components; ++c) {
      if constexpr (std::is_same_v<T, float>) {
        numbers[c] = pm_ordered(components[c]);
      } else {
        numbers[c] = components[c];
      }
    }
    return numbers;
  });
}

bool set_value(const LayerFormat& format, const ValueNumbers& numbers, std::span<std::byte> value) {
  if (format.rounding == Rounding::octahedral) {
    const std::int64_t most = 2 * octahedral_half(format);
    if (std::min(numbers[0], numbers[1]) < 0 || std::max(numbers[0], numbers[1]) > most)
      return false;
    const std::array<float, 3> vector = octahedral_value(format, numbers);
    std::memcpy(value.data(), vector.data(), sizeof(vector));
    return true;
  }
  return with_component(format.type.component, [&]<class T>(T*) {
    T components[AttributeType::kMostComponents] = {};
    for (std::size_t c = 0; c < format.type.components; ++c) {
      const std::int64_t number = numbers[c];
      if (format.rounding == Rounding::grid) {
        if (number < 0 || number > grid_most(format)) return false;
        components[c] = static_cast<T>(format.origin[c] + format.step[c] * double(number));
      } else {
        using Number = std::conditional_t<std::is_same_v<T, float>, std::int32_t, T>;
        if (number < std::int64_t{std::numeric_limits<Number>::min()} ||
            number > std::int64_t{std::numeric_limits<Number>::max()})
          return false;
        if constexpr (std::is_same_v<T, float>) {
          components[c] = pm_float(static_cast<std::int32_t>(number));
        } else {
          components[c] = static_cast<T>(number);
        }
      }
    }
    std::memcpy(value.data(), components, format.type.value_bytes());
    return true;
  });
}

std::int64_t nearest_number(const LayerFormat& format, double predicted, double fallback) {
  const bool is_float = format.type.component == ComponentType::f32;
  if (!std::isfinite(predicted)) predicted = fallback;
  if (is_float) {
    constexpr double most = std::numeric_limits<float>::max();
    if (std::isfinite(predicted)) predicted = std::clamp(predicted, -most, most);
    return pm_ordered(static_cast<float>(predicted));
  }
  return with_component(format.type.component, [&]<class T>(T*) {
    const auto low = static_cast<double>(std::numeric_limits<T>::lowest());
    const auto high = static_cast<double>(std::numeric_limits<T>::max());
    return static_cast<std::int64_t>(std::floor(std::clamp(predicted, low, high) + 0.5));
  });
}

ValueNumbers nearest_numbers(const LayerFormat& format, const RawValue& predicted,
                             const RawValue& fallback) {
  if (format.rounding != Rounding::none) {
    const bool is_finite =
        std::all_of(predicted.begin(), predicted.end(), [](double x) { return std::isfinite(x); });
    const bool is_zero = predicted[0] == 0.0 && predicted[1] == 0.0 && predicted[2] == 0.0;
    const bool is_direction = format.rounding != Rounding::octahedral || !is_zero;
    return rounded_numbers(format, is_finite && is_direction ? predicted : fallback);
  }
  ValueNumbers numbers{};
  for (std::size_t c = 0; c < format.type.components; ++c)
    numbers[c] = nearest_number(format, predicted[c], fallback[c]);
  return numbers;
}

}  // namespace mesher::progressive
