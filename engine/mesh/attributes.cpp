#include "engine/mesh/attributes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/mesh/component.h"

namespace mesher {
namespace {

/// Returns the integer that stands for 1 in normalized components.
template <class T>
double one() {
  return static_cast<double>(std::numeric_limits<T>::max());
}

template <class T>
double number_of(T value, bool is_normalized) {
  const auto number = static_cast<double>(value);
  if constexpr (std::is_integral_v<T>) {
    // The lowest signed integer stands for -1, like the one above it.
    if (is_normalized) return std::max(number / one<T>(), -1.0);
  }
  return number;
}

template <class T>
T component_of(double number, bool is_normalized) {
  if constexpr (std::is_integral_v<T>) {
    if (is_normalized) number *= one<T>();
    if (!(number > static_cast<double>(std::numeric_limits<T>::min())))
      return std::numeric_limits<T>::min();
    if (number >= one<T>()) return std::numeric_limits<T>::max();
    return static_cast<T>(std::llround(number));
  } else {
    return static_cast<T>(number);
  }
}

}  // namespace

std::string type_text(const AttributeType& type) {
  constexpr const char* kNames[] = {"s8", "u8", "s16", "u16", "u32", "f32"};
  return type.name + ": " + std::to_string(type.components) + " x " +
         kNames[static_cast<std::size_t>(type.component)] +
         (type.is_normalized ? ", normalized" : "");
}

AttributeType texcoord_type(std::uint32_t set) {
  return {AttributeKind::texcoord, "TEXCOORD_" + std::to_string(set), 2, ComponentType::f32, false};
}

AttributeType normal_type() {
  return {AttributeKind::normal, "NORMAL", 3, ComponentType::f32, false};
}

AttributeType color_type(std::uint32_t set) {
  return {AttributeKind::color, "COLOR_" + std::to_string(set), 4, ComponentType::u8, true};
}

AttributeValue load(const AttributeLayer& layer, std::size_t i) {
  const AttributeType& type = layer.type();
  return with_component(type.component, [&]<class T>(T*) {
    T components[AttributeType::kMostComponents] = {};
    std::memcpy(components, layer.value(i).data(), type.value_bytes());
    AttributeValue value{};
    for (std::size_t c = 0; c < type.components; ++c)
      value[c] = number_of(components[c], type.is_normalized);
    return value;
  });
}

void store(AttributeLayer& layer, std::size_t i, const AttributeValue& value) {
  const AttributeType& type = layer.type();
  with_component(type.component, [&]<class T>(T*) {
    T components[AttributeType::kMostComponents] = {};
    for (std::size_t c = 0; c < type.components; ++c)
      components[c] = component_of<T>(value[c], type.is_normalized);
    std::memcpy(layer.value(i).data(), components, type.value_bytes());
  });
}

bool can_blend(const AttributeType& type) {
  if (type.kind == AttributeKind::joints || type.kind == AttributeKind::weights) return false;
  return type.component == ComponentType::f32 || type.is_normalized;
}

void store_mean(AttributeLayer& layer, std::size_t i, const AttributeLayer& from, std::size_t a,
                std::size_t b) {
  with_component(from.type().component, [&]<class T>(T*) {
    T x[AttributeType::kMostComponents] = {};
    T y[AttributeType::kMostComponents] = {};
    std::memcpy(x, from.value(a).data(), from.type().value_bytes());
    std::memcpy(y, from.value(b).data(), from.type().value_bytes());
    for (std::size_t c = 0; c < from.type().components; ++c) {
      if constexpr (std::is_integral_v<T>) {
        x[c] = static_cast<T>((std::int64_t{x[c]} + std::int64_t{y[c]} + 1) >> 1);
      } else {
        x[c] = T(0.5) * (x[c] + y[c]);
      }
    }
    std::memcpy(layer.value(i).data(), x, from.type().value_bytes());
  });
}

void store_absent(AttributeLayer& layer, std::size_t i) {
  const AttributeType& type = layer.type();
  double number =
      type.component == ComponentType::f32 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  if (type.kind == AttributeKind::color) number = 1.0;
  AttributeValue value{};
  value.fill(number);
  store(layer, i, value);
}

bool is_absent(const AttributeLayer& layer, std::size_t i) {
  if (layer.type().component != ComponentType::f32) return false;
  const AttributeValue value = load(layer, i);
  return std::any_of(value.begin(), value.end(), [](double x) { return std::isnan(x); });
}

const AttributeLayer* Attributes::find(std::string_view name) const {
  const auto found = std::find_if(layers.begin(), layers.end(), [&](const AttributeLayer& layer) {
    return layer.type().name == name;
  });
  return found == layers.end() ? nullptr : &*found;
}

const AttributeLayer* Attributes::find(AttributeKind kind) const {
  const auto found = std::find_if(layers.begin(), layers.end(), [&](const AttributeLayer& layer) {
    return layer.type().kind == kind;
  });
  return found == layers.end() ? nullptr : &*found;
}

std::size_t Attributes::memory_bytes() const {
  std::size_t bytes = std::span(corner_wedge).size_bytes() + std::span(further).size_bytes() +
                      std::span(group).size_bytes();
  for (const AttributeLayer& layer : layers)
    bytes += layer.bytes().size();
  return bytes;
}

}  // namespace mesher
