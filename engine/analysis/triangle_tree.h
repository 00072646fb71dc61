#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Squared distance from a point to a triangle: that to a point of the triangle, so never less than
/// the true one but for the rounding of a difference and its square. A triangle without area counts
/// as its sides. Double throughout. O(1). (C. Ericson, "Real-Time Collision Detection",
/// 2005, 5.1.5)
double squared_distance(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle);

/// In which order the tree takes the faces.
enum class TriangleOrder : std::uint8_t {
  any,       ///< sorts them along a space-filling curve first
  by_place,  ///< takes them as they come: consecutive faces are near each other already
};

/// A tree of boxes over the triangles of a mesh, for nearest-point queries. It keeps positions of
/// its own: the mesh may change or go. Eight consecutive triangles of the curve's order make a
/// leaf, eight nodes the next level (I. Kamel, C. Faloutsos, "On packing R-trees", 1993), so that
/// the build is linear and the depth logarithmic whatever the mesh.
class TriangleTree {
 public:
  /// O(F), parallel; the same tree for any number of threads. Pre: at least one face.
  explicit TriangleTree(const Mesh& mesh, TriangleOrder order = TriangleOrder::any);

  struct Nearest {
    Face face;
    double squared_distance = 0.0;
  };

  /// The nearest triangle. `hint` is any face: one that is near makes it quick, none is wrong. The
  /// distance does not depend on it; between faces equally near the choice may. O(log F) expected.
  Nearest nearest(const glm::dvec3& p, Face hint = Face(0)) const {
    return nearest_beyond(p, hint, 0.0);
  }
  /// The same, but any triangle within `enough` (a squared distance) will do: the result is the
  /// nearest only where it is farther than that.
  Nearest nearest_beyond(const glm::dvec3& p, Face hint, double enough) const;

  /// Corners of a face, as they were. O(1).
  std::array<glm::dvec3, 3> triangle(Face f) const { return corners(place_[f.index()]); }

 private:
  static constexpr std::uint32_t kWidth = 8;
  /// The boxes of eight children: for each axis the lower and the upper end.
  struct alignas(64) Node {
    std::array<std::array<float, kWidth>, 3> min;
    std::array<std::array<float, kWidth>, 3> max;
  };
  /// Which nodes lie below one that is not a leaf.
  struct Children {
    std::uint32_t first;
    std::uint32_t count;
  };
  class Query;

  std::array<glm::dvec3, 3> corners(std::uint32_t place) const {
    const auto& t = corners_[place];
    return {t[0], t[1], t[2]};
  }
  void copy_corners(const Mesh& mesh);
  void build_leaves();
  void build_level(std::uint32_t begin, std::uint32_t end, std::uint32_t to);

  Array<std::uint32_t> order_;               ///< faces along the curve
  Array<std::uint32_t> place_;               ///< of each face in that order
  Array<std::array<glm::vec3, 3>> corners_;  ///< in that order
  Array<Node> nodes_;                        ///< leaves, then the level above them, to the root
  Array<Children> children_;                 ///< of each node above the leaves
  std::uint32_t leaves_ = 0;
};

/// The tree of a mesh, built when it is first asked for. Not for several threads at once.
class LazyTree {
 public:
  /// The mesh must stay. Pre: it has faces.
  explicit LazyTree(const Mesh& mesh, TriangleOrder order = TriangleOrder::any)
      : mesh_(mesh), order_(order) {}
  const TriangleTree& get() {
    if (!tree_) tree_.emplace(mesh_, order_);
    return *tree_;
  }

 private:
  const Mesh& mesh_;
  TriangleOrder order_;
  std::optional<TriangleTree> tree_;
};

}  // namespace mesher
