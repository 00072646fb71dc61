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

// Many formats store attributes per vertex, while CornerAttributes have one value per corner.

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

/// A value of a face, or none.
template <class T>
struct FaceValue {
  T value{};
  bool is_there = false;
};

/// Copies values of faces to their corners; the corners of faces without one keep what they have,
/// or get `absent` if `values` is empty. O(corners). Pre: one entry per face of `face_start`.
template <class T>
void spread_faces_to_corners(const Array<std::uint32_t>& face_start,
                             const Array<FaceValue<T>>& of_faces, const T& absent,
                             Array<T>& values) {
  if (of_faces.empty()) return;
  if (values.empty()) values.assign(face_start.back(), absent);
  for (std::size_t f = 0; f < of_faces.size(); ++f) {
    if (!of_faces[f].is_there) continue;
    for (std::uint32_t c = face_start[f]; c < face_start[f + 1]; ++c)
      values[c] = of_faces[f].value;
  }
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
