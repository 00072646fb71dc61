#pragma once

#include <cstdint>

#include "engine/mesh/attributes.h"

namespace mesher {

/// Calls `visit` with a null pointer to the type of a component.
template <class Visit>
decltype(auto) with_component(ComponentType type, const Visit& visit) {
  switch (type) {
    case ComponentType::s8:
      return visit(static_cast<std::int8_t*>(nullptr));
    case ComponentType::u8:
      return visit(static_cast<std::uint8_t*>(nullptr));
    case ComponentType::s16:
      return visit(static_cast<std::int16_t*>(nullptr));
    case ComponentType::u16:
      return visit(static_cast<std::uint16_t*>(nullptr));
    case ComponentType::u32:
      return visit(static_cast<std::uint32_t*>(nullptr));
    case ComponentType::f32:
      break;
  }
  return visit(static_cast<float*>(nullptr));
}

}  // namespace mesher
