#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/simplify/lanes.h"
#include "engine/simplify/report.h"
#include "engine/simplify/surface.h"

namespace mesher {

/// The faces that an edge's two ends will share once they are one: those of both stars but the one
/// or two at the edge, counter-clockwise, from one boundary to the other or around. Kept as arrays
/// of numbers, four faces at a time, and used again from edge to edge, so that nothing is
/// allocated.
class Fan {
 public:
  /// What stands against a collapse; kLegal stands for nothing.
  static constexpr auto kLegal = static_cast<Rejection>(kRejectionCount);

  Fan();

  /// Walks around the edge of `h`. Gives up and returns false where more than `limit` faces are
  /// met; what was met until then stays. O(valence).
  bool gather(const Surface& surface, Halfedge h, std::size_t limit);

  std::size_t size() const { return size_; }
  bool is_closed() const { return is_closed_; }
  /// Both ends and all neighbors are free, so that no face of the fan or of the edge has a
  /// feature.
  bool is_smooth() const { return is_smooth_; }
  /// For each face the half-edge in it that starts at the end of the edge to which it belongs.
  std::span<const Halfedge> spokes() const { return {spokes_.data(), size_}; }
  /// Neighbours: face i lies between ring()[i] and ring()[i + 1]; one more than faces where open,
  /// the first again where closed.
  std::span<const Vertex> ring() const { return {ring_.data(), size_ == 0 ? 0 : size_ + 1}; }

  /// Whether the collapse keeps a manifold of the same topology; agrees with `check_collapse`.
  /// O(valence) for few neighbors, O(valence log valence) for many. Pre: gathered.
  Rejection check_topology(const Surface& surface) const;
  /// Whether a face, with the vertex at `p`, turns over (by more than 120 degrees) or loses its
  /// area. Smaller turns and folds are a matter of degree: see turned_area. O(valence). Pre:
  /// gathered.
  Rejection check_shape(const Surface& surface, const glm::vec3& p);
  /// The area of the faces that `check_shape` found to turn far (by more than 78 degrees, or past a
  /// right angle to what they were in the input), and four times the area that is newly folded
  /// together with a neighbor.
  float turned_area() const { return turned_area_; }

  /// Where the neighbors are between which faces i to i + 3 lie: at their first ones and, one
  /// further, at their second ones. Past the last neighbor they repeat it. Pre: `check_shape` was
  /// asked.
  Vec3<Float4> four_positions(std::size_t i) const {
    return {load4(&neighbor_x_[i]), load4(&neighbor_y_[i]), load4(&neighbor_z_[i])};
  }
  /// The shape of face i with the vertex where `check_shape` was last asked about.
  FaceShape shape(std::size_t i) const { return {{x_[i + 1], y_[i + 1], z_[i + 1]}, area_[i + 1]}; }
  /// Those of faces i to i + 3, each as it lies in memory. Past the last face they hold anything.
  std::array<Float4, 4> four_shapes(std::size_t i) const {
    std::array<Float4, 4> rows{load4(&x_[i + 1]), load4(&y_[i + 1]), load4(&z_[i + 1]),
                               load4(&area_[i + 1])};
    transpose(rows[0], rows[1], rows[2], rows[3]);
    return rows;
  }
  /// That of the face before it.
  FaceShape shape_before(std::size_t i) const { return {{x_[i], y_[i], z_[i]}, area_[i]}; }
  /// Areas times unit normals of faces i to i + 7, and of the faces before each (around a closed
  /// fan the face before the first is the last). Lanes past the last face hold anything.
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
  // Of the faces, one place further than in spokes_: the place before is the last face's.
  std::vector<float> x_, y_, z_, area_;
  std::vector<float> neighbor_x_, neighbor_y_,
      neighbor_z_;  ///< of the neighbors, as four_positions
};

}  // namespace mesher
