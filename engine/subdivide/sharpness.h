#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/mesh/mesh.h"
#include "engine/subdivide/masks.h"

namespace mesher {

// Semi-sharp creases (T. DeRose, M. Kass, T. Truong, "Subdivision surfaces in character animation",
// 1998, section 5), with OpenSubdiv's rules for what the paper leaves open. All O(1).

inline bool is_semi_sharp(float sharpness) {
  return sharpness > 0.0F && sharpness < kSharpForEver;
}

/// What is left of a sharpness on the next level.
inline float decayed(float sharpness) {
  return sharpness >= kSharpForEver ? kInfinitelySharp : std::max(sharpness - 1.0F, 0.0F);
}

/// The semi-sharp edges at a vertex, summed up; smooth ones and those for ever do not count.
class SemiSharpSum {
 public:
  void add(float sharpness) {
    if (!is_semi_sharp(sharpness)) return;
    sum_ += sharpness;
    ++count_;
  }
  /// Of all but one edge of that sharpness. Pre: it was added, and has_others().
  double mean_of_others(float sharpness) const { return (sum_ - sharpness) / (count_ - 1); }
  bool has_others() const { return count_ > 1; }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

/// The same by Chaikin's rule, for the half of the edge at one end; `at_end` are the edges there,
/// this one included.
float chaikin_decayed(float sharpness, const SemiSharpSum& at_end);

/// Whether a vertex stays, moves along a crease or freely.
enum class VertexRule : std::uint8_t { smooth, crease, corner };
VertexRule vertex_rule(float own, std::size_t sharp_edges);

/// The sharpnesses at a vertex, some of which may just have fallen to 0, as they decay: how much
/// the sharper, older rule counts, 0 to 1. `before` and `after` are parallel.
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

/// How much the sharp mask counts for the new vertex on an edge; `first` and `second` are what is
/// left of its sharpness on its halves. OpenSubdiv 3.5 does not keep it below 1, and overshoots
/// where Chaikin's rule wears one half of a sharper edge down to 0; here it is.
inline double edge_blend(float sharpness, float first, float second) {
  if (first > 0.0F && second > 0.0F) return 1.0;
  return std::min(1.0, static_cast<double>(sharpness));
}

}  // namespace mesher
