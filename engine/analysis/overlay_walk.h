#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/mesh/mesh.h"

namespace mesher {

/// Bounds how far the points of a triangle may be from a surface that runs beside it, without a
/// search tree: projects the faces of the surface along the normal of the triangle, walks over
/// those whose projections meet it, and takes the largest height. The projections cover the
/// triangle if none of the faces visited is turned over and no boundary edge meets the triangle: a
/// path from the first face to any point of the triangle can be lifted face by face. All decisions
/// keep a margin above rounding. Not for several threads at once.
class OverlayWalk {
 public:
  explicit OverlayWalk(const Mesh& surface) : surface_(surface) {}

  /// The face above or below the middle of the triangle, if the walk from `hint` finds one, else
  /// none. A few steps from a hint that is near.
  Face locate(const std::array<glm::dvec3, 3>& triangle, Face hint);
  /// An upper bound for the distance of any point of the triangle that was last located, rounding
  /// of the result (1e-15 of the coordinates) aside; infinite where the walk fails or the bound
  /// would be above `most`. Pre: `start` is what `locate` returned, and valid. O(faces over the
  /// triangle).
  double bound(Face start, double most);

 private:
  /// A corner in the triangle's frame: two coordinates in its plane, and the height.
  using Projected = glm::dvec3;
  /// A half-edge to walk over, and where its ends are.
  struct Crossing {
    Halfedge halfedge;
    Projected from;
    Projected to;
  };

  Projected projected(Vertex v) const;
  bool meets(const Projected& from, const Projected& to) const;
  double height(const std::array<Projected, 3>& face, double turn_of_face, double enough) const;
  bool is_new(Face f);
  bool cross(Halfedge h, const Projected& from, const Projected& to);

  const Mesh& surface_;
  glm::dvec3 origin_{0.0};
  std::array<glm::dvec3, 3> axes_{};
  std::array<Projected, 3> corners_{};  ///< of the triangle
  double size_ = 0.0;
  std::vector<Crossing> stack_;
  // A small hash table of the faces visited; entries of former walks have other numbers.
  static constexpr std::size_t kSlots = 2048;
  static constexpr std::uint32_t kMostFaces = 768;
  struct Slot {
    Face face;
    std::uint32_t walk = 0;
  };
  std::array<Slot, kSlots> visited_{};
  std::uint32_t walk_ = 0;
  std::uint32_t faces_ = 0;
};

}  // namespace mesher
