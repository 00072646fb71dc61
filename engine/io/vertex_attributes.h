#pragma once

#include <cstring>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "engine/core/array.h"
#include "engine/core/parallel.h"
#include "engine/mesh/ids.h"

namespace mesher::io {

// Many formats store attributes per vertex, while mesher stores one per corner.

/// Copies per-vertex values to corners. O(corners), parallel. Throws Cancelled. Pre: indices are in
/// range.
template <class T>
Array<T> spread_to_corners(std::span<const std::uint32_t> corners, const Array<T>& of_vertices,
                           Progress* progress = nullptr) {
  Array<T> values;
  if (of_vertices.empty()) return values;
  values.resize(corners.size());
  parallel_chunks(corners.size(), std::size_t{1} << 15, progress,
                  [&](std::size_t, IndexRange range) {
                    for (std::size_t c = range.begin; c < range.end; ++c)
                      values[c] = of_vertices[corners[c]];
                  });
  return values;
}

/// Returns one value per vertex if all corners at each vertex agree bit for bit (`unused` for
/// vertices without corners); otherwise, or if there are no values, empty. O(corners).
template <class T>
Array<T> gather_to_vertices(std::span<const Vertex> origins, std::size_t vertex_count,
                            const Array<T>& of_corners, const T& unused) {
  Array<T> values;
  if (of_corners.empty()) return values;
  values.assign(vertex_count, unused);
  for (std::size_t h = 0; h < origins.size(); ++h)
    values[origins[h].index()] = of_corners[h];
  for (std::size_t h = 0; h < origins.size(); ++h) {
    if (std::memcmp(&values[origins[h].index()], &of_corners[h], sizeof(T)) != 0) return {};
  }
  return values;
}

}  // namespace mesher::io
