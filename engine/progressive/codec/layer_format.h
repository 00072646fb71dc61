#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/mesh/attributes.h"

namespace mesher::progressive {

/// How the values of a layer become integers.
enum class Rounding : std::uint8_t {
  none,        ///< integers as they are, floats by pm_ordered
  grid,        ///< floats on a grid per component
  octahedral,  ///< unit vectors as two numbers
};

inline constexpr unsigned kPmLeastValueBits = 4;
inline constexpr unsigned kPmMostValueBits = 16;

/// The integers that stand for a value.
using ValueNumbers = std::array<std::int64_t, AttributeType::kMostComponents>;
/// The components of a value as they are stored: integers are not fractions.
using RawValue = std::array<double, AttributeType::kMostComponents>;

/// A layer of a file: its type, and how its values are coded.
struct LayerFormat {
  AttributeType type;
  bool is_faceted = false;
  /// All values have unit length (in their first three components), so the largest component
  /// follows from the others.
  bool is_unit = false;
  Rounding rounding = Rounding::none;
  unsigned bits = 0;                                            ///< per number; 0 without rounding
  std::array<double, AttributeType::kMostComponents> origin{};  ///< of the grid
  std::array<double, AttributeType::kMostComponents> step{};

  std::size_t number_count() const {
    return rounding == Rounding::octahedral ? 2 : std::size_t{type.components};
  }
};

RawValue raw_value(const AttributeType& type, std::span<const std::byte> value);

/// Returns the numbers of a value: the nearest ones if the layer is rounded.
ValueNumbers numbers_of(const LayerFormat& format, std::span<const std::byte> value);
/// Sets the value that numbers stand for. Returns false if they stand for none.
bool set_value(const LayerFormat& format, const ValueNumbers& numbers, std::span<std::byte> value);
/// Returns the numbers nearest to a predicted value, which may be any.
ValueNumbers nearest_numbers(const LayerFormat& format, const RawValue& predicted,
                             const RawValue& fallback);
/// Same for one number, without rounding.
std::int64_t nearest_number(const LayerFormat& format, double predicted, double fallback);

}  // namespace mesher::progressive
