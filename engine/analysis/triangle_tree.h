#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// Returns the squared distance from a point to a triangle. It is measured to a point of the
/// triangle, so it is never below the true distance, apart from the rounding of a difference and
/// its square. A triangle without area counts as its sides. Computed in double. O(1). (C. Ericson,
/// "Real-Time Collision Detection", 2005, 5.1.5)
double squared_distance(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle);

/// The order of the faces that the tree is built from.
enum class TriangleOrder : std::uint8_t {
  any,        ///< the tree sorts them along a space-filling curve
  presorted,  ///< the tree keeps their order: consecutive faces are already near each other
};

/// A bounding-box tree over the triangles of a mesh, for nearest-point queries. It copies the
/// positions, so the mesh may change or be destroyed. A leaf holds eight consecutive triangles of
/// the curve's order, and an inner node eight nodes of the level below (I. Kamel, C. Faloutsos, "On
/// packing R-trees", 1993), so that the build is linear and the depth logarithmic for any mesh.
class TriangleTree {
 public:
  /// Builds the tree. O(F), parallel; the same tree for any number of threads. Pre: at least one
  /// face.
  explicit TriangleTree(const Mesh& mesh, TriangleOrder order = TriangleOrder::any);

  struct Nearest {
    Face face;
    double squared_distance = 0.0;
  };

  /// Returns the nearest triangle. `hint` may be any face; a near one makes the query faster. The
  /// hint does not affect the distance, but may affect the choice between equally near faces. O(log
  /// F) expected.
  Nearest nearest(const glm::dvec3& p, Face hint = Face(0)) const {
    return nearest_beyond(p, hint, 0.0);
  }
  /// Returns any triangle within `enough` (a squared distance) if there is one, otherwise the
  /// nearest triangle.
  Nearest nearest_beyond(const glm::dvec3& p, Face hint, double enough) const;

  /// Appends the triangles within a squared distance of a point to `found`, at most `most` of them,
  /// in an order that depends on the mesh alone. O(log F + found) expected.
  void within(const glm::dvec3& p, double squared, std::size_t most,
              std::vector<Face>& found) const;

  /// Returns the corners of a face at the time of the build. O(1).
  std::array<glm::dvec3, 3> triangle(Face f) const { return corners(index_in_order_[f.index()]); }

 private:
  static constexpr std::uint32_t kWidth = 8;
  /// The boxes of eight children: the lower and upper ends on each axis.
  struct alignas(64) Node {
    std::array<std::array<float, kWidth>, 3> min;
    std::array<std::array<float, kWidth>, 3> max;
  };
  /// The children of an inner node.
  struct Children {
    std::uint32_t first;
    std::uint32_t count;
  };
  class Query;

  std::array<glm::dvec3, 3> corners(std::uint32_t index) const {
    const auto& t = corners_[index];
    return {t[0], t[1], t[2]};
  }
  void copy_corners(const Mesh& mesh);
  void build_leaves();
  void build_level(std::uint32_t begin, std::uint32_t end, std::uint32_t to);

  Array<std::uint32_t> order_;               ///< faces along the curve
  Array<std::uint32_t> index_in_order_;      ///< the index of each face in order_
  Array<std::array<glm::vec3, 3>> corners_;  ///< in the order of order_
  Array<Node> nodes_;                        ///< the leaves, then each level above them up to the
                                             ///< root
  Array<Children> children_;                 ///< of each inner node
  std::uint32_t leaves_ = 0;
};

/// The tree of a mesh, built on first use. Not thread-safe.
class LazyTree {
 public:
  /// Pre: the mesh has faces and outlives this object.
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

}  // namespace mesher::analysis
