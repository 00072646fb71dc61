#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/analysis/triangle_reach.h"
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

  /// Goes to the face above or below the middle of the triangle, a few steps from a hint that is
  /// near. Returns its height there, infinite where the walk fails. `shrink`: the triangle's
  /// corners are moved towards the middle by that part of the way for all that follows, so that
  /// faces which it only touches do not count.
  double locate(const Triangle& triangle, Face hint, double shrink);
  /// An upper bound for the distance of any point of the shrunken triangle that was last located,
  /// rounding of the result (1e-15 of the coordinates) aside; infinite where the walk fails or the
  /// bound would be above `most`. Pre: `locate` has not failed. O(faces over the triangle).
  double bound(double most);

 private:
  /// A corner in the triangle's frame: two coordinates in its plane, and the height.
  using Projected = glm::dvec3;
  /// The same, and where that is as seen from the triangle's sides.
  struct Seen {
    Projected at;
    std::array<double, 3> inside;  ///< distance from each side, times its length; positive inside
    double extent;                 ///< the largest of the triangle's and of the coordinates
  };
  /// A half-edge to walk over, and where its ends are.
  struct Crossing {
    Halfedge halfedge;
    Seen from;
    Seen to;
  };

  Projected projected(Vertex v) const;
  Seen seen(const Projected& at) const;
  bool meets(const Seen& from, const Seen& to) const;
  double height(const std::array<Projected, 3>& face, double turn_of_face, double enough) const;
  static double height_of_common_part(const std::array<Projected, 3>& face,
                                      std::array<Projected, 9>& part);
  double walk_from_around(Face hint);
  double walk_to_middle(Face from);
  Triangle corners(Face f) const;
  double slope(Face f) const;
  bool is_new(Face f);
  bool cross(Halfedge h, const Seen& from, const Seen& to);

  const Mesh& surface_;
  glm::dvec3 origin_{0.0};
  std::array<glm::dvec3, 3> axes_{};
  std::array<Projected, 3> corners_{};  ///< of the triangle
  std::array<glm::dvec3, 3> sides_{};   ///< what `inside` is: x times, y times, and what is added
  double size_ = 0.0;
  // The face located, from one of its half-edges on.
  Halfedge start_;
  std::array<Projected, 3> start_corners_{};
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
