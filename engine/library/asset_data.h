#pragma once

#include <mesher/asset.h>

#include "engine/mesh/model.h"

namespace mesher {

/// The engine's model behind the face. Assets share it and do not change it.
struct Asset::Data {
  Model model;
};

/// Returns positions in the type of the face. The arrays are the same.
inline std::span<const std::array<float, 3>> face_positions(const Mesh& mesh) {
  static_assert(sizeof(glm::vec3) == sizeof(std::array<float, 3>));
  return {reinterpret_cast<const std::array<float, 3>*>(mesh.positions().data()),
          mesh.positions().size()};
}

/// Returns ids in the type of the face. The arrays are the same.
template <class Tag>
std::span<const std::uint32_t> face_ids(std::span<const Id<Tag>> ids) {
  static_assert(kNoElement == kNone);
  return {reinterpret_cast<const std::uint32_t*>(ids.data()), ids.size()};
}

}  // namespace mesher
