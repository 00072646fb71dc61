#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "engine/analysis/attributed_surface.h"
#include "engine/core/array.h"

namespace mesher::analysis {

/// Finds points of a surface by their texture coordinates. Charts may overlap, and whole faces may
/// have one texture coordinate; of all points with the same ones, the nearest to a point in space
/// is found. A tree of boxes in five dimensions: two of the texture, three in space. Faces without
/// texture coordinates are not in it.
class UvTree {
 public:
  /// Builds the tree. O(F). Keeps copies, so the surface may change afterwards.
  explicit UvTree(const AttributedSurface& surface);

  /// Returns the squared distance from `near` to the nearest point with these texture coordinates,
  /// up to a millionth of the largest one; infinity if there is none. O(log F) expected if
  /// few charts overlap near that point.
  double squared_distance(const glm::dvec2& uv, const glm::dvec3& near) const;

 private:
  static constexpr std::size_t kFanout = 8;
  struct UvTriangle {
    std::array<glm::dvec2, 3> uv;
    std::array<glm::dvec3, 3> position;
  };
  struct UvBox {
    glm::dvec2 uv_min{std::numeric_limits<double>::infinity()};
    glm::dvec2 uv_max{-std::numeric_limits<double>::infinity()};
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    void add(const UvTriangle& triangle);
    void add(const UvBox& box);
  };
  struct UvQuery {
    glm::dvec2 uv;
    glm::dvec3 near;
    double least = std::numeric_limits<double>::infinity();
  };

  /// Returns the squared distance from the query's point to a box; infinity if the box is not below
  /// what was found, or does not hold the texture coordinates.
  double bound(const UvQuery& query, const UvBox& box) const;
  double squared_distance(const UvQuery& query, const UvTriangle& triangle) const;
  void visit(UvQuery& query, std::size_t level, std::size_t box) const;

  std::vector<UvTriangle> triangles_;       ///< along a curve through space
  std::vector<std::vector<UvBox>> levels_;  ///< boxes of eight triangles, of eight such boxes, ...
  double tolerance_ = 0.0;                  ///< of texture coordinates
};

}  // namespace mesher::analysis
