#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/core/lanes.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/report.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// Returns the area of the equilateral triangle that is as high as a face over its longest side. A
/// face that turns moves no farther than this height, so a sliver that turns is less harmful than
/// its area suggests.
template <class F>
F compact_area(const F& area, const F& squared_longest_side) {
  constexpr float kFourBySquareRootOfThree = 2.3094011F;
  const F tiny = broadcast<F>(1e-30F);
  return area * (area / greater_of(squared_longest_side, tiny)) *
         broadcast<F>(kFourBySquareRootOfThree);
}

/// The faces around the merged vertex of an edge: those of both stars except the one or two at the
/// edge, counterclockwise, from one boundary to the other or all the way around. Stored as arrays,
/// in groups of four faces, and reused from edge to edge so that nothing is allocated.
class Fan {
 public:
  /// Why a collapse is not allowed; kLegal if it is.
  static constexpr auto kLegal = static_cast<Rejection>(kRejections.size());

  Fan();

  /// Gathers the faces around the edge of `h`. Stops and returns false if there are more than
  /// `limit`; the faces gathered so far remain. O(valence).
  bool gather(const Surface& surface, Halfedge h, std::size_t limit);

  std::size_t size() const { return size_; }
  bool is_closed() const { return is_closed_; }
  /// Returns whether both ends and all neighbors are unconstrained, so that no face of the fan or
  /// the edge has a feature.
  bool is_smooth() const { return is_smooth_; }
  /// Returns, per face, its half-edge that starts at the end of the edge to which it belongs.
  std::span<const Halfedge> spokes() const { return {spokes_.data(), size_}; }
  /// Returns the neighbors: face i lies between ring()[i] and ring()[i + 1]. An open fan has one
  /// more neighbor than faces; a closed fan repeats the first.
  std::span<const Vertex> ring() const { return {ring_.data(), size_ == 0 ? 0 : size_ + 1}; }

  /// Checks whether the collapse preserves a manifold of the same topology; agrees with
  /// `check_collapse`. O(valence) for few neighbors, O(valence log valence) for many. Pre:
  /// gathered.
  Rejection check_topology(const Surface& surface) const;
  /// Checks whether, with the vertex at `p`, a face turns by more than 120 degrees or becomes
  /// degenerate. Smaller turns and folds are not refused but penalized: see turned_area.
  /// O(valence). Pre: gathered.
  Rejection check_shape(const Surface& surface, const glm::vec3& p);
  /// Returns the compact area (see `compact_area`), found by `check_shape`, of the faces that turn
  /// far (by more than 78 degrees, or past a right angle to their normal in the input), plus four
  /// times the newly folded one between adjacent faces.
  float turned_area() const { return turned_area_; }

  /// Returns the positions of the first neighbors of faces i to i + 3; called with i + 1, those of
  /// their second neighbors. Repeats the last neighbor past the end. Pre: `check_shape` was called.
  Vec3<Float4> four_positions(std::size_t i) const {
    return {load4(&neighbor_x_[i]), load4(&neighbor_y_[i]), load4(&neighbor_z_[i])};
  }
  /// Returns the shape of face i with the vertex at the position last passed to `check_shape`.
  FaceShape shape(std::size_t i) const { return {{x_[i + 1], y_[i + 1], z_[i + 1]}, area_[i + 1]}; }
  /// Returns the shapes of faces i to i + 3 as rows. Rows past the last face are unspecified.
  std::array<Float4, 4> four_shapes(std::size_t i) const {
    std::array<Float4, 4> rows{load4(&x_[i + 1]), load4(&y_[i + 1]), load4(&z_[i + 1]),
                               load4(&area_[i + 1])};
    transpose(rows[0], rows[1], rows[2], rows[3]);
    return rows;
  }
  /// Returns the shape of the face before face i.
  FaceShape shape_before(std::size_t i) const { return {{x_[i], y_[i], z_[i]}, area_[i]}; }
  /// Return areas times unit normals of faces i to i + 7, and of the face before each of them (in a
  /// closed fan, the last face comes before the first). Lanes past the last face are unspecified.
  Vec3<Float8> area_vectors(std::size_t i) const { return area_vectors_before(i + 1); }
  Vec3<Float8> area_vectors_before(std::size_t i) const {
    const auto eight = [&](const std::vector<float>& from) {
      return Float8{load4(&from[i]), load4(&from[i + 4])};
    };
    return Vec3<Float8>{eight(x_), eight(y_), eight(z_)} * eight(area_);
  }

 private:
  struct Block;

  void reserve(std::size_t faces);
  bool append(const Mesh& mesh, Halfedge spoke, std::size_t limit);
  bool has_smooth_ring(const Surface& surface) const;
  bool gather_closed(const Mesh& mesh, std::size_t limit);
  bool gather_open(const Mesh& mesh, std::size_t limit);
  bool keeps_boundary(const Mesh& mesh) const;
  bool has_repeated_neighbor() const;
  Block load(const Surface& surface, std::size_t i) const;
  void pad_positions(const Surface& surface);
  float folded_area_after(const Surface& surface) const;
  float folded_area_before(const Surface& surface) const;

  Halfedge edge_;
  std::size_t size_ = 0;
  bool is_closed_ = false;
  bool is_smooth_ = false;
  bool has_smooth_ends_ = false;
  float turned_area_ = 0.0F;
  std::vector<Halfedge> spokes_;
  std::vector<Vertex> ring_;
  // By face, shifted by one from spokes_: slot 0 repeats the last face.
  std::vector<float> x_, y_, z_, area_, compact_area_;
  std::vector<float> neighbor_x_, neighbor_y_, neighbor_z_;  ///< see four_positions
};

}  // namespace mesher::simplify
