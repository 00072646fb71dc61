#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/ids.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/surface.h"

namespace mesher {

inline bool do_overlap(const Box& a, const Box& b) {
  // One value instead of six branches that nobody can predict.
  return (static_cast<unsigned>(a.min.x <= b.max.x) & static_cast<unsigned>(b.min.x <= a.max.x) &
          static_cast<unsigned>(a.min.y <= b.max.y) & static_cast<unsigned>(b.min.y <= a.max.y) &
          static_cast<unsigned>(a.min.z <= b.max.z) & static_cast<unsigned>(b.min.z <= a.max.z)) !=
         0;
}

/// A binary tree of boxes over faces that move and vanish. The faces keep their leaves; a box grows
/// with what moves in it and never shrinks. A tree that has lost half of its faces should be built
/// again.
class FaceTree {
 public:
  /// `leaf_of`: by face, written for the faces of this tree alone, so that trees of different
  /// regions can share it.
  explicit FaceTree(std::span<std::uint32_t> leaf_of) : leaf_of_(leaf_of) {}

  /// Pre: faces that are near in space are near in the order. O(faces).
  void build(const Surface& surface, std::vector<Face> faces);
  /// The faces it was built from; some may have been removed.
  const std::vector<Face>& faces() const { return faces_; }

  /// Notes that a face has moved into `box`. O(log faces), mostly O(1).
  void grow(Face f, const Box& box);

  /// Calls `visit(face)` for each face whose leaf's box overlaps `box` (removed ones, too) until it
  /// returns true; returns whether it did. O(log faces) expected for small boxes.
  template <class Visit>
  bool any_of(const Box& box, const Visit& visit) const {
    if (levels_.empty()) return false;
    struct Node {
      std::uint32_t level;
      std::uint32_t index;
    };
    std::array<Node, 2 * std::numeric_limits<std::uint32_t>::digits> stack;
    std::size_t size = 0;
    stack[size++] = {static_cast<std::uint32_t>(levels_.size() - 1), 0};
    while (size > 0) {
      const auto [level, index] = stack[--size];
      if (!do_overlap(levels_[level][index], box)) continue;
      if (level > 0) {
        const bool has_two = 2 * index + 1 < levels_[level - 1].size();
        if (has_two) stack[size++] = {level - 1, 2 * index + 1};
        stack[size++] = {level - 1, 2 * index};
        continue;
      }
      const std::size_t end = std::min(kLeafFaces * (index + 1), faces_.size());
      for (std::size_t i = kLeafFaces * index; i < end; ++i) {
        if (visit(faces_[i])) return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t kLeafFaces = 4;

  std::span<std::uint32_t> leaf_of_;
  std::vector<Face> faces_;
  std::vector<Array<Box>> levels_;  ///< from leaves to the root
};

}  // namespace mesher
