#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/analysis/triangle_pair.h"
#include "engine/core/array.h"
#include "engine/simplify/face_tree.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/surface.h"
#include "engine/simplify/territory.h"

namespace mesher::simplify {

/// State shared by the guards of all regions.
struct GuardedSpace {
  explicit GuardedSpace(std::uint32_t faces) : slot_of(faces) {}

  Array<std::uint32_t> slot_of;  ///< by face: see FaceTree
  Territory territory;
  bool has_regions = false;  ///< the territory applies
};

/// Prevents collapses from making faces intersect (after S. Gumhold, P. Borodin, R. Klein,
/// "Intersection-free simplification", 2003). Tests the new faces around the merged vertex against
/// all faces near them, exactly. Pairs that already intersect may keep intersecting. There is one
/// guard per region, and it sees the region's faces only: while regions run concurrently, a
/// collapse that leaves the region's territory is left to a later round.
class IntersectionGuard {
 public:
  enum class Verdict : std::uint8_t { legal, intersects, outside_territory };

  /// Guards the faces whose corners all belong to the region. O(faces).
  IntersectionGuard(const Surface& surface, GuardedSpace& space, std::uint32_t region,
                    std::span<const Vertex> vertices);

  /// Checks merging the edge of the fan at `p`. O(valence (near faces + valence) + log faces)
  /// expected. Pre: no face of the fan becomes degenerate.
  Verdict check(const Surface& surface, const Fan& fan, Vertex removed, Vertex kept,
                const glm::vec3& p);
  /// Follows a collapse, checked or not. Call after it is done. O(valence log faces), mostly
  /// O(valence).
  void collapsed(const Surface& surface, const Fan& fan);

 private:
  /// Vectors in space, as separate coordinates.
  struct Vectors {
    std::vector<float> x, y, z;

    void resize(std::size_t size) {
      for (std::vector<float>* numbers : {&x, &y, &z})
        numbers->resize(size);
    }
    void set(std::size_t i, const glm::dvec3& v) {
      x[i] = static_cast<float>(v.x);
      y[i] = static_cast<float>(v.y);
      z[i] = static_cast<float>(v.z);
    }
    /// Returns the dot products of vectors i to i + 3 with `v`.
    Float4 dots(std::size_t i, const glm::vec3& v) const {
      return load4(&x[i]) * (Float4{} + v.x) + load4(&y[i]) * (Float4{} + v.y) +
             load4(&z[i]) * (Float4{} + v.z);
    }
    /// Lengths of vectors i to i + 3 in the L1 norm.
    Float4 lengths(std::size_t i) const {
      const std::array<Float4, 3> v{load4(&x[i]), load4(&y[i]), load4(&z[i])};
      return greater_of(v[0], -v[0]) + greater_of(v[1], -v[1]) + greater_of(v[2], -v[2]);
    }
  };
  /// A triangle near the new faces, relative to their vertex.
  struct NearTriangle {
    std::array<Vertex, 3> corner;
    std::array<glm::vec3, 3> position;
    glm::vec3 normal;            ///< not of unit length
    float normal_length = 0.0F;  ///< in the L1 norm; infinite if the direction is uncertain
    float offset = 0.0F;         ///< of the plane, times the length of the normal
    float reach = 0.0F;          ///< largest L1 distance of a corner from the vertex
  };
  /// Which corners of four new faces, other than their vertex, a triangle shares.
  struct SharedCorners {
    std::array<Int4, 3> is_begin;
    std::array<Int4, 3> is_end;
  };
  /// One side of each new face, projected: its direction, and the offset that corrects distances
  /// (the projection of the vertex is the origin).
  struct Sides {
    std::vector<float> x, y, shift;

    void set(std::size_t i, const glm::dvec2& direction, double distance) {
      x[i] = static_cast<float>(direction.x);
      y[i] = static_cast<float>(direction.y);
      shift[i] = static_cast<float>(distance);
    }
    /// Distances of a point from this side of faces i to i + 3, times the lengths of the sides;
    /// positive inside.
    Float4 distances(std::size_t i, float px, float py) const {
      return load4(&x[i]) * (Float4{} + py) - load4(&y[i]) * (Float4{} + px) + load4(&shift[i]);
    }
    /// Lengths of the sides in the L1 norm.
    Float4 lengths(std::size_t i) const {
      const Float4 dx = load4(&x[i]);
      const Float4 dy = load4(&y[i]);
      return greater_of(dx, -dx) + greater_of(dy, -dy);
    }
  };

  void place_faces(const Surface& surface, const Fan& fan, const glm::vec3& p);
  void flatten(const Fan& fan);
  glm::dvec2 flattened(const glm::dvec3& p) const;
  NearTriangle near_triangle(const analysis::ExactTriangle& t,
                             const std::array<Vertex, 3>& corner) const;
  static SharedCorners shared_corners(const Fan& fan, std::size_t i, const NearTriangle& other);
  Int4 find_one_sided(std::size_t i, const SharedCorners& shared, const NearTriangle& other) const;
  Int4 find_apart(std::size_t i, const SharedCorners& shared, const NearTriangle& other) const;
  bool has_new_pair(const Surface& surface, const Fan& fan) const;
  bool has_new_pair(const Surface& surface, const Fan& fan, Face other, const LaneBox& box) const;

  GuardedSpace& space_;
  std::uint32_t region_;
  FaceTree tree_;
  std::size_t removed_ = 0;  ///< number of faces removed since the tree was built
  // New faces of the fan that was last checked.
  std::vector<analysis::ExactTriangle> triangles_;
  std::vector<LaneBox> boxes_;
  Box all_;
  Vectors ring_;        ///< corners of the new faces, relative to their vertex
  Vectors normals_;     ///< of the new faces, not of unit length
  float reach_ = 0.0F;  ///< largest L1 distance of a corner from the vertex
  // The same, projected along their mean normal, where they form a graph over that plane.
  bool is_graph_ = false;
  std::array<glm::dvec3, 2> axes_{};
  std::array<Sides, 3> sides_;
  float flat_reach_ = 0.0F;  ///< largest L1 distance of a corner from the vertex
};

}  // namespace mesher::simplify
