#pragma once

#include <cstdint>
#include <optional>

#include "engine/mesh/attributes.h"

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

/// Returns the name of a vector of 1 to 4 components.
constexpr const char* gltf_shape(std::size_t components) {
  constexpr const char* kShapes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kShapes[components - 1];
}

}  // namespace mesher::io
