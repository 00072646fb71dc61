#include "engine/progressive/codec/attribute_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace mesher::progressive {
namespace {

constexpr std::size_t kMostNameBytes = 65'535;

// Bits of a layer's flags.
constexpr std::uint32_t kNormalized = 1;
constexpr std::uint32_t kCountsDown = 2;
constexpr std::uint32_t kLinear = 4;
constexpr std::uint32_t kFaceted = 8;
constexpr std::uint32_t kUnit = 16;

class TableWriter {
 public:
  void u8(std::uint32_t value) { number(value, 1); }
  void u32(std::uint32_t value) { number(value, 4); }
  void f64(double value) { number(std::bit_cast<std::uint64_t>(value), 8); }
  void text(const std::string& text) {
    const std::size_t length = std::min(text.size(), kMostNameBytes);
    number(length, 2);
    for (const char c : text.substr(0, length))
      bytes.push_back(static_cast<std::byte>(c));
  }

  Array<std::byte> bytes;

 private:
  void number(std::uint64_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i)
      bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
  }
};

/// Reads numbers and texts; zeros once the bytes have ended.
class TableReader {
 public:
  explicit TableReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  std::uint32_t u8() { return static_cast<std::uint32_t>(number(1)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  double f64() { return std::bit_cast<double>(number(8)); }
  std::string text() {
    const std::size_t length = number(2);
    if (length > rest_.size()) {
      is_short_ = true;
      return {};
    }
    std::string text(reinterpret_cast<const char*>(rest_.data()), length);
    rest_ = rest_.subspan(length);
    return text;
  }
  /// Returns whether more was read than there is.
  bool is_short() const { return is_short_; }
  bool is_at_end() const { return rest_.empty(); }

 private:
  std::uint64_t number(unsigned count) {
    if (count > rest_.size()) {
      is_short_ = true;
      return 0;
    }
    std::uint64_t value = 0;
    for (unsigned i = 0; i < count; ++i)
      value |= std::to_integer<std::uint64_t>(rest_[i]) << (8 * i);
    rest_ = rest_.subspan(count);
    return value;
  }

  std::span<const std::byte> rest_;
  bool is_short_ = false;
};

void put_layer(TableWriter& out, const LayerFormat& layer) {
  const AttributeType& type = layer.type;
  out.text(type.name);
  out.u8(static_cast<std::uint32_t>(type.kind));
  out.u8(static_cast<std::uint32_t>(type.component));
  out.u8(type.components);
  out.u8((type.is_normalized ? kNormalized : 0) | (type.counts_down ? kCountsDown : 0) |
         (type.is_linear ? kLinear : 0) | (layer.is_faceted ? kFaceted : 0) |
         (layer.is_unit ? kUnit : 0));
  out.u8(static_cast<std::uint32_t>(layer.rounding));
  out.u8(layer.bits);
  if (layer.rounding != Rounding::grid) return;
  for (std::size_t c = 0; c < type.components; ++c) {
    out.f64(layer.origin[c]);
    out.f64(layer.step[c]);
  }
}

bool is_usable_rounding(const LayerFormat& layer) {
  if (layer.rounding == Rounding::none) return layer.bits == 0;
  if (layer.type.component != ComponentType::f32) return false;
  if (layer.bits < kPmLeastValueBits || layer.bits > kPmMostValueBits) return false;
  if (layer.rounding == Rounding::octahedral) return layer.type.components == 3;
  for (std::size_t c = 0; c < layer.type.components; ++c) {
    constexpr double most = std::numeric_limits<float>::max() * (1.0 + 1e-9);
    const double last = layer.origin[c] + layer.step[c] * double((1U << layer.bits) - 1);
    if (!(layer.step[c] > 0.0) || !(std::abs(layer.origin[c]) <= most) || !(std::abs(last) <= most))
      return false;
  }
  return true;
}

/// Returns whether the layer makes sense.
bool take_layer(TableReader& in, LayerFormat& layer) {
  AttributeType& type = layer.type;
  type.name = in.text();
  const std::uint32_t kind = in.u8();
  const std::uint32_t component = in.u8();
  const std::uint32_t components = in.u8();
  const std::uint32_t flags = in.u8();
  const std::uint32_t rounding = in.u8();
  layer.bits = in.u8();
  if (kind > static_cast<std::uint32_t>(AttributeKind::custom) ||
      component > static_cast<std::uint32_t>(ComponentType::f32) || components < 1 ||
      components > AttributeType::kMostComponents || flags >= 2 * kUnit ||
      rounding > static_cast<std::uint32_t>(Rounding::octahedral)) {
    return false;
  }
  if (!is_layer_name(type.name)) return false;
  type.kind = static_cast<AttributeKind>(kind);
  type.component = static_cast<ComponentType>(component);
  type.components = static_cast<std::uint8_t>(components);
  type.is_normalized = (flags & kNormalized) != 0;
  type.counts_down = (flags & kCountsDown) != 0;
  type.is_linear = (flags & kLinear) != 0;
  layer.is_faceted = (flags & kFaceted) != 0;
  layer.is_unit = (flags & kUnit) != 0;
  layer.rounding = static_cast<Rounding>(rounding);
  for (std::size_t c = 0; layer.rounding == Rounding::grid && c < components; ++c) {
    layer.origin[c] = in.f64();
    layer.step[c] = in.f64();
  }
  if (layer.is_faceted && type.kind != AttributeKind::normal) return false;
  if (layer.is_unit && (type.component != ComponentType::f32 || components < 3)) return false;
  return is_usable_rounding(layer);
}

}  // namespace

Array<std::byte> encode_table(const AttributeTable& table) {
  TableWriter out;
  out.u8(static_cast<std::uint32_t>(table.layers.size()));
  for (const LayerFormat& layer : table.layers)
    put_layer(out, layer);
  out.u8(table.has_face_groups ? 1 : 0);
  out.u32(static_cast<std::uint32_t>(table.groups.size()));
  for (const FaceGroup& group : table.groups) {
    out.text(group.object);
    out.text(group.name);
    out.text(group.smoothing);
    out.u32(group.material);
    out.u32(group.mesh);
    out.u32(group.primitive);
  }
  return std::move(out.bytes);
}

std::string_view decode_table(std::span<const std::byte> bytes, AttributeTable& table) {
  constexpr std::string_view why = "the table of attributes makes no sense";
  TableReader in(bytes);
  const std::uint32_t layers = in.u8();
  std::set<std::string> names;
  for (std::uint32_t k = 0; k < layers; ++k) {
    LayerFormat& layer = table.layers.emplace_back();
    if (!take_layer(in, layer) || !names.insert(layer.type.name).second) return why;
  }
  const std::uint32_t has_face_groups = in.u8();
  const std::uint32_t groups = in.u32();
  table.has_face_groups = has_face_groups != 0;
  for (std::uint32_t k = 0; k < groups && !in.is_short(); ++k) {
    FaceGroup& group = table.groups.emplace_back();
    group.object = in.text();
    group.name = in.text();
    group.smoothing = in.text();
    group.material = in.u32();
    group.mesh = in.u32();
    group.primitive = in.u32();
  }
  if (in.is_short() || !in.is_at_end() || has_face_groups > 1) return why;
  if (table.has_face_groups && table.groups.empty()) return why;
  return {};
}

}  // namespace mesher::progressive
