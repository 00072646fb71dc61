#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <utility>

#include "engine/core/array.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/codec/split_ring.h"

namespace mesher::progressive {

/// Neighborhoods from which the positions of parent and child are predicted, relative to the
/// parent.
struct SplitSides {
  glm::dvec3 parent{0.0};  ///< mean of the parent's future neighbors, opening edges included
  glm::dvec3 child{0.0};
  glm::dvec3 parent_normal{0.0};  ///< of its faces, twice their area long
  glm::dvec3 child_normal{0.0};
  glm::dvec3 opening{0.0};  ///< from the left to the right vertex

  SplitSides(const SplitRing& ring, const SplitCut& cut) {
    const std::uint32_t last = ring.slots() - 1;
    if (cut.right == kNone) {
      sum(ring, cut.left, last, child, child_normal);
      sum(ring, 0, cut.left, parent, parent_normal);
    } else {
      sum(ring, cut.left, cut.right, child, child_normal);
      sum(ring, cut.right, cut.left, parent, parent_normal);
      opening = ring.offset(cut.right) - ring.offset(cut.left);
    }
  }

 private:
  static void sum(const SplitRing& ring, std::uint32_t begin, std::uint32_t end, glm::dvec3& middle,
                  glm::dvec3& normal) {
    middle = ring.offset(begin);
    double count = 1.0;
    for (std::uint32_t slot = begin; slot != end; count += 1.0) {
      const std::uint32_t next = ring.after(slot);
      middle += ring.offset(next);
      // Past the end of an open fan there is no face.
      if (ring.is_closed() || next != 0) normal += cross(ring.offset(slot), ring.offset(next));
      slot = next;
    }
    middle /= count;
  }
};

/// Predicted position of a point, and its uncertainty by direction.
struct PositionPrediction {
  glm::dvec3 mean;
  glm::dvec3 normal;       ///< not zero
  bool has_plane = false;  ///< dot(normal, point) equals `plane`, except for rounding
  double plane = 0.0;
  double variance = 1.0;    ///< perpendicular to the normal
  glm::dvec3 stretch{0.0};  ///< the variance is three times as large in this direction
};

/// Three coordinates, indexable by axis.
using Coordinates = std::array<double, 3>;

inline Coordinates coordinates(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

/// Order in which coordinates are coded: the axis along which the normal is longest comes last,
/// because the coordinates known so far help to predict the next. A "step" is a position in this
/// order.
class CoordinateOrder {
 public:
  explicit CoordinateOrder(const PositionPrediction& prediction)
      : has_plane_(prediction.has_plane), plane_(prediction.plane) {
    const glm::dvec3& n = prediction.normal;
    const Coordinates size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    const bool is_x_first = size[0] >= size[1];
    const int larger = is_x_first ? 0 : 1;
    axis_[2] = size[static_cast<std::size_t>(larger)] >= size[2] ? larger : 2;
    axis_[0] = axis_[2] == 0 ? 1 : 0;
    axis_[1] = axis_[2] == 2 ? 1 : 2;
    mean_ = by_step(prediction.mean);
    normal_ = by_step(prediction.normal);
    const Coordinates stretch = by_step(prediction.stretch);
    const double nn = dot(n, n);
    const double ss = dot(prediction.stretch, prediction.stretch);
    const double weight = ss > 0.0 ? 2.0 / ss : 0.0;
    const auto covariance = [&](std::size_t a, std::size_t b) {
      const double flat = (a == b ? 1.0 : 0.0) - normal_[a] * normal_[b] / nn;
      return flat + weight * (stretch[a] * stretch[b]);
    };
    const double first = covariance(0, 0);
    follow_ = covariance(0, 1) / first;
    variance_[0] = prediction.variance * first;
    variance_[1] = prediction.variance * (covariance(1, 1) - follow_ * covariance(0, 1));
    variance_[2] = prediction.variance * nn / (normal_[2] * normal_[2]);
  }

  int axis(std::size_t step) const { return axis_[step]; }
  double variance(std::size_t step) const { return variance_[step]; }
  /// Returns the predicted coordinate of a step. `point` has the coordinates of the steps before
  /// it.
  template <std::size_t kStep>
  double mean(const Coordinates& point) const {
    const Coordinates& m = mean_;
    const Coordinates& n = normal_;
    if constexpr (kStep == 0) return m[0];
    if constexpr (kStep == 1) return m[1] + follow_ * (point[0] - m[0]);
    if (has_plane_) return (plane_ - n[0] * point[0] - n[1] * point[1]) / n[2];
    return m[2] - (n[0] * (point[0] - m[0]) + n[1] * (point[1] - m[1])) / n[2];
  }
  /// Returns the coordinates in the order of the steps.
  Coordinates by_step(const glm::dvec3& v) const {
    const Coordinates all = coordinates(v);
    return {all[static_cast<std::size_t>(axis_[0])], all[static_cast<std::size_t>(axis_[1])],
            all[static_cast<std::size_t>(axis_[2])]};
  }

 private:
  bool has_plane_;
  double plane_;
  std::array<int, 3> axis_;
  Coordinates mean_;
  Coordinates normal_;
  double follow_;
  Coordinates variance_;
};

/// Models residuals: differences between coordinates and their predictions.
class ResidualCoder {
 public:
  /// `width`: approximate expected size of the residual, in bits. `shift`: by how many bits the
  /// numbers are finer here than elsewhere.
  template <std::size_t kStep, class Coder>
  std::int64_t code(Coder& coder, bool has_plane, int width, int shift, std::int64_t difference) {
    if (kStep < 2 || !has_plane) {
      const unsigned at = context(width);
      return side_[kStep][at].code(coder, lowest(at, kStep < 2 ? 5 : 7), difference);
    }
    // Off a plane, the residual is rounding or depends on how vertices were placed: recent
    // residuals predict its size.
    const unsigned at = context(static_cast<int>(std::bit_width(recent_)) + shift);
    difference = plane_[at].code(coder, lowest(at, 7), difference);
    const auto off = static_cast<std::uint64_t>(difference < 0 ? -difference : difference);
    recent_ = recent_ - recent_ / 16 + (off >> static_cast<unsigned>(shift));
    return difference;
  }

 private:
  static constexpr int kContexts = 40;

  static unsigned context(int value) {
    return static_cast<unsigned>(std::clamp(value, 0, kContexts - 1));
  }
  static unsigned lowest(unsigned at, unsigned below) { return at < below ? 0 : at - below; }

  HintedIntegerCoder side_[3][kContexts];
  HintedIntegerCoder plane_[kContexts];
  std::uint64_t recent_ = 0;
};

/// Returns the biased exponent of a double: 1023 for 1.
inline int exponent_of(double value) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(value) >> 52U & 0x7FFU);
}

/// Constrains a prediction to a plane. A volume-preserving collapse places its vertex in a plane
/// that follows from the positions of its two ends (P. Lindstrom, G. Turk, "Fast and memory
/// efficient polygonal simplification", 1998), so one of the six coordinates is known. `plane`:
/// value of dot(normal, point); ignored if far from the prediction.
inline void use_plane(PositionPrediction& prediction, const glm::dvec3& normal, double plane) {
  const double nn = dot(normal, normal);
  if (!(nn > 0.0) || plane * plane > 16.0 * prediction.variance * nn) return;
  prediction.normal = normal;
  prediction.plane = plane;
  prediction.has_plane = true;
}

inline glm::dvec3 normal_of(const SplitSides& s) {
  const glm::dvec3 n = s.parent_normal + s.child_normal;
  return dot(n, n) > 0.0 ? n : glm::dvec3(0.0, 0.0, 1.0);
}

/// Which of the two vertices kept the position that the parent had before the split.
enum class UnmovedEnd : std::uint8_t { neither = 0, parent = 1, child = 2 };

class UnmovedEndCoder {
 public:
  template <class Coder>
  UnmovedEnd code(Coder& coder, UnmovedEnd unmoved) {
    if (!coder.bit(any_, unmoved != UnmovedEnd::neither)) return UnmovedEnd::neither;
    return coder.bit(which_, unmoved == UnmovedEnd::child) ? UnmovedEnd::child : UnmovedEnd::parent;
  }

 private:
  AdaptiveBitModel any_;
  AdaptiveBitModel which_;
};

}  // namespace mesher::progressive
