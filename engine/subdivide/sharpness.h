#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/mesh/mesh.h"
#include "engine/subdivide/masks.h"

namespace mesher::subdivide {

// Semi-sharp creases (T. DeRose, M. Kass, T. Truong, "Subdivision surfaces in character animation",
// 1998, section 5). Where the paper is silent, OpenSubdiv's rules apply. All O(1).

inline bool is_semi_sharp(float sharpness) {
  return sharpness > 0.0F && sharpness < kSharpForEver;
}

/// Returns a sharpness on the next level.
inline float decayed(float sharpness) {
  return sharpness >= kSharpForEver ? kInfinitelySharp : std::max(sharpness - 1.0F, 0.0F);
}

/// The sum over the semi-sharp edges at a vertex; smooth and permanently sharp edges do not count.
class SemiSharpSum {
 public:
  void add(float sharpness) {
    if (!is_semi_sharp(sharpness)) return;
    sum_ += sharpness;
    ++count_;
  }
  /// Returns the mean over all but one edge of that sharpness. Pre: it was added, and has_others().
  double mean_of_others(float sharpness) const { return (sum_ - sharpness) / (count_ - 1); }
  bool has_others() const { return count_ > 1; }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

/// Returns a sharpness on the next level by Chaikin's rule, for the half of the edge at one end.
/// `at_end`: the edges at that end, including this one.
float chaikin_decayed(float sharpness, const SemiSharpSum& at_end);

/// The rule that a vertex follows: free, along a crease, or fixed.
enum class VertexRule : std::uint8_t { smooth, crease, corner };
VertexRule vertex_rule(float own, std::size_t sharp_edges);

/// The blend between the rules of two levels at a vertex where sharpnesses fall to 0: the weight of
/// the sharper, older rule, 0 to 1. Each sharpness is added with its value before and after the
/// step.
class Transition {
 public:
  void add(float before, float after) {
    if (before > 0.0F && after <= 0.0F) {
      sum_ += before;
      ++count_;
    }
  }
  double weight() const { return count_ == 0 ? 0.0 : std::min(1.0, sum_ / count_); }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

/// Returns the weight of the sharp mask for the new vertex on an edge. `first` and `second` are the
/// sharpnesses of its halves on the next level. OpenSubdiv 3.5 does not clamp the weight to 1, and
/// overshoots if Chaikin's rule reduces one half of an edge of sharpness above 1 to 0; this
/// function clamps it.
inline double edge_blend(float sharpness, float first, float second) {
  if (first > 0.0F && second > 0.0F) return 1.0;
  return std::min(1.0, static_cast<double>(sharpness));
}

}  // namespace mesher::subdivide
