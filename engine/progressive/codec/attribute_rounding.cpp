#include "engine/progressive/codec/attribute_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mesher::progressive {
namespace {

/// What the values of a layer have in common, at all levels.
struct ValueRange {
  RawValue low;
  RawValue high;
  bool is_finite = true;
  bool is_unit = true;  ///< in the first three components

  ValueRange() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }

  void add(const AttributeLayer& layer) {
    constexpr double kUnitTolerance = 1e-3;
    for (std::size_t i = 0; i < layer.count(); ++i) {
      const RawValue value = raw_value(layer.type(), layer.value(i));
      for (std::size_t c = 0; c < layer.type().components; ++c) {
        is_finite = is_finite && std::isfinite(value[c]);
        low[c] = std::min(low[c], value[c]);
        high[c] = std::max(high[c], value[c]);
      }
      const double square = value[0] * value[0] + value[1] * value[1] + value[2] * value[2];
      is_unit = is_unit && std::abs(square - 1.0) < kUnitTolerance;
    }
  }
};

unsigned bits_for(const AttributeRounding& rounding, AttributeKind kind) {
  switch (kind) {
    case AttributeKind::texcoord:
      return rounding.texcoord;
    case AttributeKind::normal:
      return rounding.normal;
    case AttributeKind::tangent:
      return rounding.tangent;
    case AttributeKind::color:
      return rounding.color;
    case AttributeKind::weights:
      return rounding.weights;
    case AttributeKind::delta:
      return rounding.delta;
    case AttributeKind::joints:
    case AttributeKind::custom:
      break;
  }
  return 0;
}

void round(LayerFormat& format, const ValueRange& range, unsigned bits) {
  if (bits == 0 || !range.is_finite || !(range.low[0] <= range.high[0])) return;
  const AttributeType& type = format.type;
  if (type.kind == AttributeKind::normal && type.components == 3) {
    if (!range.is_unit) return;
    format.rounding = Rounding::octahedral;
    format.is_unit = false;
  } else {
    const double steps = static_cast<double>((1U << bits) - 1);
    for (std::size_t c = 0; c < type.components; ++c) {
      format.origin[c] = range.low[c];
      const double side = range.high[c] - range.low[c];
      format.step[c] = side > 0.0 ? side / steps : 1.0;
    }
    format.rounding = Rounding::grid;
    format.is_unit = false;
  }
  format.bits = bits;
}

}  // namespace

AttributeTable make_table(const ProgressiveAttributes& attributes,
                          const AttributeRounding* rounding) {
  AttributeTable table;
  table.groups = attributes.groups();
  table.has_face_groups = !attributes.group().empty();
  for (std::size_t k = 0; k < attributes.layers().size(); ++k) {
    const AttributeLayer& layer = attributes.layers()[k];
    const AttributeType& type = layer.type();
    LayerFormat& format = table.layers.emplace_back();
    format.type = type;
    format.is_faceted = attributes.is_faceted(k);
    if (type.component != ComponentType::f32) continue;
    ValueRange range;
    range.add(layer);
    range.add(attributes.other_values()[k]);
    format.is_unit = type.components >= 3 && range.is_finite && range.is_unit;
    if (rounding != nullptr) round(format, range, bits_for(*rounding, type.kind));
  }
  return table;
}

}  // namespace mesher::progressive
