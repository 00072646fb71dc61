#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "engine/mesh/attributes.h"
#include "engine/mesh/material.h"

namespace mesher::io {

/// Returns the number by which glTF knows the type of a component.
constexpr std::uint32_t gltf_number(ComponentType type) {
  switch (type) {
    case ComponentType::s8:
      return 5120;
    case ComponentType::u8:
      return 5121;
    case ComponentType::s16:
      return 5122;
    case ComponentType::u16:
      return 5123;
    case ComponentType::u32:
      return 5125;
    case ComponentType::f32:
      break;
  }
  return 5126;
}

/// Returns the type of that number, or nothing if there is none.
constexpr std::optional<ComponentType> component_type(std::uint64_t number) {
  for (const ComponentType type : {ComponentType::s8, ComponentType::u8, ComponentType::s16,
                                   ComponentType::u16, ComponentType::u32, ComponentType::f32}) {
    if (gltf_number(type) == number) return type;
  }
  return std::nullopt;
}

/// How a texture is minified.
struct GltfMinFilter {
  bool is_nearest = false;  ///< within a level
  Mipmaps mipmaps = Mipmaps::blended;

  friend bool operator==(const GltfMinFilter&, const GltfMinFilter&) = default;
};
inline constexpr std::pair<std::uint32_t, GltfMinFilter> kGltfMinFilters[] = {
    {9728, {true, Mipmaps::none}},    {9729, {false, Mipmaps::none}},
    {9984, {true, Mipmaps::nearest}}, {9985, {false, Mipmaps::nearest}},
    {9986, {true, Mipmaps::blended}}, {9987, {false, Mipmaps::blended}}};

/// Returns the filter of that number, the best one if there is none.
constexpr GltfMinFilter min_filter(std::uint64_t number) {
  for (const auto& [known, filter] : kGltfMinFilters) {
    if (known == number) return filter;
  }
  return {};
}

/// Returns the number of a filter.
constexpr std::uint32_t min_filter_number(const GltfMinFilter& filter) {
  for (const auto& [known, other] : kGltfMinFilters) {
    if (other == filter) return known;
  }
  return 0;
}

/// Returns the name of a vector of 1 to 4 components.
constexpr const char* gltf_shape(std::size_t components) {
  constexpr const char* kShapes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kShapes[components - 1];
}

}  // namespace mesher::io
