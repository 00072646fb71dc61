#pragma once

#include "engine/mesh/build/soup.h"

namespace mesher::io {

/// Drops `face_start` if all faces are triangles. O(F).
inline void forget_triangle_starts(Soup& soup) {
  for (std::size_t f = 0; f < soup.face_start.size(); ++f) {
    if (soup.face_start[f] != 3 * f) return;
  }
  soup.face_start = {};
}

}  // namespace mesher::io
