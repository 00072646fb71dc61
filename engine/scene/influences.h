#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/shape.h"

namespace mesher::scene {

/// How much a vertex follows a joint of its skin.
struct Influence {
  std::uint32_t joint = 0;
  float weight = 0.0F;
  friend bool operator==(const Influence&, const Influence&) = default;
};

/// The joints that the vertices of a skinned mesh follow. The weights of a vertex have a sum of 1.
struct Influences {
  std::uint32_t per_vertex = 0;  ///< 0: the mesh has no joints
  Array<Influence> list;

  std::span<const Influence> of(Vertex v) const {
    return std::span(list).subspan(std::size_t{v.index()} * per_vertex, per_vertex);
  }
};

/// Returns the influences of a shape's layers JOINTS_0, WEIGHTS_0, JOINTS_1 and so on. A vertex
/// without weights follows joint 0. O(V).
Influences influences_of(const Shape& shape);

}  // namespace mesher::scene
