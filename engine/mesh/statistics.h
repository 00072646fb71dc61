#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// An axis-aligned box. Empty (min > max) for a mesh without vertices.
struct Box {
  glm::vec3 min{1.0F};
  glm::vec3 max{-1.0F};
  friend bool operator==(const Box&, const Box&) = default;
  bool is_empty() const { return min.x > max.x; }
  glm::dvec3 center() const { return 0.5 * (glm::dvec3(min) + glm::dvec3(max)); }
  /// Returns the length of the diagonal, 0 if empty. In double, because the square of a float may
  /// overflow.
  double diagonal() const;
};

/// Enlarges a box so that it contains a point.
inline void extend(Box& box, const glm::vec3& p) {
  if (box.is_empty()) box = {p, p};
  box.min = glm::min(box.min, p);
  box.max = glm::max(box.max, p);
}
/// Returns whether all coordinates are numbers.
inline bool is_finite(const glm::vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
/// Enlarges a box so that it contains another one after a transform. Corners that the transform
/// takes beyond the range of numbers are left out.
void extend(Box& box, const Box& by, const glm::dmat4& transform);

/// Returns the box of all positions. O(V), parallel.
Box bounding_box(const Mesh& mesh);

/// Returns the number of closed loops of boundary edges. O(V). Throws Cancelled.
std::uint32_t count_boundary_loops(const Mesh& mesh, Progress* progress = nullptr);

/// Returns the component of each face, numbered from 0 by lowest face. The number of components is
/// one more than the highest number. O(F). Throws Cancelled.
std::vector<std::uint32_t> face_components(const Mesh& mesh, Progress* progress = nullptr);

/// The figures that `info` and the panel show.
struct Statistics {
  std::uint32_t vertices = 0;
  std::uint32_t edges = 0;
  std::uint32_t faces = 0;
  std::uint32_t boundary_edges = 0;
  std::uint32_t boundary_loops = 0;
  std::uint32_t components = 0;  ///< of faces; isolated vertices not counted
  std::uint32_t isolated_vertices = 0;
  std::uint32_t crease_edges = 0;  ///< sharpness > 0, boundary not counted
  std::uint32_t zero_area_faces = 0;
  std::int64_t euler_characteristic = 0;  ///< V - E + F, without isolated vertices
  double area = 0.0;                      ///< square model units
  double volume = 0.0;                    ///< signed, cubic model units; meaningful if closed
  Box box;

  bool is_closed() const { return boundary_edges == 0; }
};

/// One of the counts, with its words. `info`, JSON and the panel show them in this order.
struct Count {
  const char* key;    ///< in JSON
  const char* label;  ///< in messages and panels
  std::int64_t (*of)(const Statistics&);
  bool hides_zero = false;  ///< in messages and panels
};
inline constexpr std::array kCounts{
    Count{"vertices", "vertices", [](const Statistics& s) { return std::int64_t(s.vertices); }},
    Count{"edges", "edges", [](const Statistics& s) { return std::int64_t(s.edges); }},
    Count{"faces", "faces", [](const Statistics& s) { return std::int64_t(s.faces); }},
    Count{"boundary_edges", "boundary edges",
          [](const Statistics& s) { return std::int64_t(s.boundary_edges); }},
    Count{"boundary_loops", "boundary loops",
          [](const Statistics& s) { return std::int64_t(s.boundary_loops); }},
    Count{"components", "components",
          [](const Statistics& s) { return std::int64_t(s.components); }},
    Count{"euler_characteristic", "Euler characteristic",
          [](const Statistics& s) { return s.euler_characteristic; }},
    Count{"crease_edges", "crease edges",
          [](const Statistics& s) { return std::int64_t(s.crease_edges); }},
    Count{"isolated_vertices", "isolated vertices",
          [](const Statistics& s) { return std::int64_t(s.isolated_vertices); }, true},
    Count{"zero_area_faces", "zero-area faces",
          [](const Statistics& s) { return std::int64_t(s.zero_area_faces); }, true},
};

/// Returns the statistics of a mesh. O(F). Throws Cancelled.
Statistics statistics(const Mesh& mesh, Progress* progress = nullptr);

}  // namespace mesher
