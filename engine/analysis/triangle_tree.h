#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Squared distance from a point to a triangle, exact but for rounding; a triangle without area
/// counts as its sides. Double throughout. O(1).
double squared_distance(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle);

/// A tree of boxes over the triangles of a mesh, for nearest-point questions. It keeps positions of
/// its own: the mesh may change or go.
class TriangleTree {
 public:
  /// O(F log F). Pre: at least one face.
  explicit TriangleTree(const Mesh& mesh);

  struct Nearest {
    Face face;
    double squared_distance = 0.0;
  };

  /// The nearest triangle. `hint` is any face: one that is near makes it quick, none is wrong. The
  /// distance does not depend on it; between faces equally near the choice may. O(log F) expected.
  Nearest nearest(const glm::dvec3& p, Face hint = Face(0)) const;

 private:
  struct Box {
    glm::vec3 min;
    glm::vec3 max;
  };
  /// Inner nodes have their children next to one another.
  struct Node {
    Box box;
    std::uint32_t first;  ///< child, or index into order_
    std::uint32_t count;  ///< of triangles; 0: an inner node
  };

  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  Box box_of(std::uint32_t begin, std::uint32_t end) const;
  std::array<glm::dvec3, 3> triangle(Face f) const;
  static double squared_distance_to(const Box& box, const glm::dvec3& p);

  std::vector<std::array<glm::vec3, 3>> corners_;
  std::vector<std::uint32_t> order_;  ///< faces, leaf after leaf
  std::vector<Node> nodes_;
};

}  // namespace mesher
