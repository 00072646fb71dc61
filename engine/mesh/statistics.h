#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/mesh/mesh.h"

namespace mesher {

/// Axis-aligned box. Empty (min > max) for a mesh without vertices.
struct Box {
  glm::vec3 min{1.0F};
  glm::vec3 max{-1.0F};
  bool is_empty() const { return min.x > max.x; }
  glm::dvec3 center() const { return 0.5 * (glm::dvec3(min) + glm::dvec3(max)); }
  /// Length of the diagonal, 0 where empty. Double: the square of a float may overflow.
  double diagonal() const;
};

/// Box of all positions. O(V), parallel.
Box bounding_box(const Mesh& mesh);

/// Each boundary loop, as the half-edges without twin that follow one another (with the surface on
/// their left). O(F) time.
std::vector<std::vector<Halfedge>> boundary_loops(const Mesh& mesh);

/// Component of each face, counted from 0 by lowest face; the number of components is one more than
/// the highest. O(F) time.
std::vector<std::uint32_t> face_components(const Mesh& mesh);

/// What `info` and the panel show.
struct Statistics {
  std::uint32_t vertices = 0;
  std::uint32_t edges = 0;
  std::uint32_t faces = 0;
  std::uint32_t boundary_edges = 0;
  std::uint32_t boundary_loops = 0;
  std::uint32_t components = 0;  ///< of faces; an isolated vertex is not counted
  std::uint32_t isolated_vertices = 0;
  std::uint32_t crease_edges = 0;  ///< sharpness > 0, boundary not counted
  std::uint32_t zero_area_faces = 0;
  std::int64_t euler_characteristic = 0;  ///< V - E + F, isolated vertices left out
  double area = 0.0;                      ///< square model units
  double volume = 0.0;                    ///< signed, cubic model units; meaningful where closed
  Box box;

  bool is_closed() const { return boundary_edges == 0; }
};

/// O(F) time.
Statistics statistics(const Mesh& mesh);

}  // namespace mesher
