#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/analysis/triangle_reach.h"
#include "engine/mesh/mesh.h"

namespace mesher::analysis {

/// Bounds the distance from the points of a triangle to a surface that runs alongside it, without a
/// search tree. It projects the faces of the surface along the triangle's normal, walks over the
/// faces whose projections meet the triangle, and takes the largest height. The projections cover
/// the triangle if no visited face is flipped and no boundary edge meets the triangle: then a path
/// from the first face to any point of the triangle can be lifted face by face. All decisions keep
/// a margin above rounding. Not thread-safe.
class OverlayWalk {
 public:
  explicit OverlayWalk(const Mesh& surface) : surface_(surface) {}

  /// Walks from a nearby hint to the face above or below the middle of the triangle, which takes a
  /// few steps. Returns the face's height there, or infinity if the walk fails. `shrink` is the
  /// fraction of the way by which the triangle's corners move toward its middle for the following
  /// calls, so that faces that it only touches do not count.
  double locate(const Triangle& triangle, Face hint, double shrink);
  /// Returns the face that was located last. Pre: `locate` did not fail.
  Face located() const { return Mesh::face(start_); }
  /// Returns an upper bound for the distance of any point of the shrunken triangle that was located
  /// last, apart from rounding of the result (1e-15 of the coordinates). Returns infinity if the
  /// walk fails or the bound would exceed `most`. O(faces over the triangle). Pre: `locate` did not
  /// fail.
  double bound(double most);

 private:
  /// A corner in the triangle's frame: two coordinates in its plane, and the height above it.
  using Projected = glm::dvec3;
  /// A projected corner and its position relative to the triangle's sides.
  struct Seen {
    Projected at;
    std::array<double, 3> inside;  ///< distance from each side times the side's length, positive
                                   ///< inside
    double extent;                 ///< the largest of the triangle's size and the coordinates
  };
  /// A half-edge to cross, with its projected ends.
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
  std::array<glm::dvec3, 3> sides_{};   ///< coefficients of `inside`: x, y and the constant
  double size_ = 0.0;
  // The located face, as one of its half-edges.
  Halfedge start_;
  std::array<Projected, 3> start_corners_{};
  std::vector<Crossing> stack_;
  // A small hash table of the visited faces. Entries of earlier walks have other walk numbers.
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

}  // namespace mesher::analysis
