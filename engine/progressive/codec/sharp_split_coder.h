#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/codec/sharpness_coder.h"
#include "engine/progressive/codec/split_ring.h"
#include "engine/progressive/vertex_split.h"

namespace mesher::progressive {

/// Models the sharpness of the edges that a split adds and of those that it opens.
class SharpSplitCoder {
 public:
  template <class Coder>
  std::string_view code(Coder& coder, const Mesh& mesh, const SplitRing& ring, NewSplit& split) {
    SplitSharpness& s = split.sharpness;
    s.edge = edge_.code(coder, s.edge);
    bool is_good = is_sharpness(s.edge);
    is_good &=
        code_side(coder, mesh.sharpness(ring.halfedge(split.cut.left)), s.sides[0], s.sides[1]);
    if (split.cut.right == kNone) {
      s.sides[2] = s.sides[3] = 0.0F;
    } else {
      is_good &=
          code_side(coder, mesh.sharpness(ring.halfedge(split.cut.right)), s.sides[2], s.sides[3]);
    }
    return is_good ? std::string_view{}
                   : "the sharpness of a split is not that of the level before";
  }

 private:
  /// Codes both halves of an opened edge. The larger sharpness of the two is that of the edge
  /// before.
  template <class Coder>
  bool code_side(Coder& coder, float before, float& first, float& second) {
    const bool is_first = coder.bit(has_first_[before > 0.0F], has_same_bits(first, before));
    const bool is_second =
        !is_first || coder.bit(has_second_[before > 0.0F], has_same_bits(second, before));
    first = is_first ? before : other_.code(coder, first);
    second = is_second ? before : other_.code(coder, second);
    return has_same_bits(std::max(first, second), before) && is_sharpness(first) &&
           is_sharpness(second);
  }

  SharpnessCoder edge_;
  SharpnessCoder other_;
  AdaptiveBitModel has_first_[2];
  AdaptiveBitModel has_second_[2];
};

/// Models the sharpness of the parent and child vertices themselves.
class SharpCornerCoder {
 public:
  template <class Coder>
  std::string_view code(Coder& coder, const Mesh& mesh, NewSplit& split) {
    const float before = mesh.sharpness(split.parent);
    const bool is_good = code_one(coder, before, split.parent_corner_sharpness, 0) &&
                         code_one(coder, before, split.child_corner_sharpness, 1);
    return is_good ? std::string_view{} : "the sharpness of a vertex is not a number from 0 on";
  }

 private:
  template <class Coder>
  bool code_one(Coder& coder, float before, float& value, std::size_t which) {
    const bool stays =
        coder.bit(stays_[2 * which + std::size_t{before > 0.0F}], has_same_bits(value, before));
    value = stays ? before : value_.code(coder, value);
    return is_sharpness(value);
  }

  AdaptiveBitModel stays_[4];
  SharpnessCoder value_;
};

}  // namespace mesher::progressive
