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
#include "engine/core/lanes.h"
#include "engine/mesh/ids.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

/// A box as two vectors of lanes, so that an overlap test takes one comparison of each.
struct alignas(32) LaneBox {
  static constexpr bool kLeftUninitialized = true;

  LaneBox() = default;
  explicit LaneBox(const Box& b)
      : min{b.min.x, b.min.y, b.min.z, 0.0F}, max{b.max.x, b.max.y, b.max.z, 0.0F} {}

  Float4 min;
  Float4 max;
};

inline bool do_overlap(const LaneBox& a, const LaneBox& b) {
  return !any((a.min > b.max) | (b.min > a.max));
}

inline bool contains(const LaneBox& outer, const LaneBox& inner) {
  return !any((inner.min < outer.min) | (inner.max > outer.max));
}

inline LaneBox join(const LaneBox& a, const LaneBox& b) {
  LaneBox sum;
  sum.min = a.min < b.min ? a.min : b.min;
  sum.max = a.max > b.max ? a.max : b.max;
  return sum;
}

/// A binary tree of boxes over faces that move and vanish. The boxes of faces are exact, and faces
/// stay in their leaves. Inner boxes grow with their faces and never shrink. Rebuild the tree when
/// half of its faces are removed.
class FaceTree {
 public:
  /// `slot_of`: slot in the tree by face. Written for the faces of this tree only, so trees of
  /// different regions can share it.
  explicit FaceTree(std::span<std::uint32_t> slot_of) : slot_of_(slot_of) {}

  /// Builds the tree. Pre: faces near in space are near in the order. O(faces).
  void build(const Surface& surface, std::vector<Face> faces);
  /// Returns the faces from which the tree was built; some may be removed by now.
  const std::vector<Face>& faces() const { return faces_; }

  /// Records that a face has moved and now has this box. O(log faces), mostly O(1).
  void move(Face f, const LaneBox& box);

  /// Calls `visit(face, its box)` for each face whose box overlaps `box` (removed faces included)
  /// until `visit` returns true. Returns whether it did. O(log faces) expected for small boxes.
  template <class Visit>
  bool any_of(const LaneBox& box, const Visit& visit) const {
    if (faces_.empty() || !do_overlap(nodes_[1], box)) return false;
    std::array<std::uint32_t, 2 * std::numeric_limits<std::uint32_t>::digits> stack;
    std::size_t size = 0;
    stack[size++] = 1;
    while (size > 0) {
      const std::uint32_t node = stack[--size];
      if (node < first_leaf_) {
        // Branch-free: which child overlaps is unpredictable.
        for (const std::uint32_t child : {2 * node + 1, 2 * node}) {
          stack[size] = child;
          size += static_cast<std::size_t>(do_overlap(nodes_[child], box));
        }
        continue;
      }
      const std::size_t begin = kLeafFaces * (node - first_leaf_);
      const std::size_t end = std::min(begin + kLeafFaces, faces_.size());
      for (std::size_t i = begin; i < end; ++i) {
        if (do_overlap(boxes_[i], box) && visit(faces_[i], boxes_[i])) return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t kLeafFaces = 8;

  std::span<std::uint32_t> slot_of_;
  std::vector<Face> faces_;
  std::vector<LaneBox> boxes_;  ///< of the faces
  /// The root is 1; the children of i are 2 i and 2 i + 1. Leaves are padded to a power of two with
  /// boxes that overlap nothing.
  std::vector<LaneBox> nodes_;
  std::uint32_t first_leaf_ = 1;
};

}  // namespace mesher::simplify
