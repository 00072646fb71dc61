#pragma once

#include "engine/core/lanes.h"

namespace mesher::simplify {

/// Quadric of the faces around a vertex, for moving the vertex by y. `y^T a y` is the sum of the
/// faces' areas times the squared distances to their planes. `g.y` is three times the swept volume,
/// where g is the sum of the areas times the unit normals.
///
/// The quadric is built from the current faces (memoryless: P. Lindstrom, G. Turk, "Fast and memory
/// efficient polygonal simplification", 1998; weighted by area as in H. Hoppe, "New quadric metric
/// for simplifying meshes with appearance attributes", 1999), so all planes pass through the
/// vertex. With the vertex as the origin, the linear and the constant term vanish. Nine floats
/// suffice, and no precision is lost far from the model's origin.
template <class F>
struct Quadric {
  F xx, xy, xz, yy, yz, zz;  ///< the upper triangle of a
  Vec3<F> g;

  friend Quadric operator+(const Quadric& p, const Quadric& q) {
    return {p.xx + q.xx, p.xy + q.xy, p.xz + q.xz, p.yy + q.yy,
            p.yz + q.yz, p.zz + q.zz, p.g + q.g};
  }
  friend Quadric operator-(const Quadric& p, const Quadric& q) {
    return {p.xx - q.xx, p.xy - q.xy, p.xz - q.xz, p.yy - q.yy,
            p.yz - q.yz, p.zz - q.zz, p.g - q.g};
  }
  Vec3<F> times(const Vec3<F>& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z};
  }
  /// Returns the sum of the areas.
  F trace() const { return xx + yy + zz; }
};

/// A quadric as three rows of four floats, in memory order. The remaining lanes of the last row do
/// not belong to the quadric.
struct QuadricRows {
  Float4 a;  ///< xx xy xz yy
  Float4 b;  ///< yz zz, g.x g.y
  Float4 c;  ///< g.z

  friend QuadricRows operator+(const QuadricRows& p, const QuadricRows& q) {
    return {p.a + q.a, p.b + q.b, p.c + q.c};
  }
  friend QuadricRows operator-(const QuadricRows& p, const QuadricRows& q) {
    return {p.a - q.a, p.b - q.b, p.c - q.c};
  }
};

/// Returns weight * n n^T, with g = weight * n.
template <class F>
Quadric<F> plane_quadric(const Vec3<F>& n, F weight) {
  const Vec3<F> w = n * weight;
  return {w.x * n.x, w.x * n.y, w.x * n.z, w.y * n.y, w.y * n.z, w.z * n.z, w};
}

/// Damping of directions in which the quadric is weak, as a fraction of its trace. `best_offset`
/// pulls toward the midpoint by this much, so that the vertex stays in the middle in flat and
/// straight neighborhoods, where the quadric leaves directions free.
inline constexpr float kPlacementDamping = 8e-5F;
/// Tie-break: weight of the squared edge length times the area around it, so that the shorter of
/// two equally good edges goes first. It corresponds to a distance of 3e-7 of the edge length, the
/// resolution of single precision, so it does not compete with real errors.
inline constexpr float kTieBreak = 1e-13F;
/// Rounding error of the quadric's six sums, as a fraction of area times squared length. Costs
/// below it are not significant, so queued costs are lowered by it until the edge is evaluated
/// exactly. (Ten times as much is no better on flat parts; on a fandisk two of three edges are then
/// evaluated twice.)
inline constexpr float kQuadricNoise = 1e-7F;
/// Same for guessed costs, far from the target: a guess needs no second evaluation.
inline constexpr float kGuessNoise = 1e-6F;
/// Below this fraction rounding is visible, and `plane_costs` computes the cost when the edge
/// reaches the front of the queue: a slope of 0.001.
inline constexpr float kQuadricDoubt = 1e-6F;

/// An edge whose ends are merged at midpoint + y: cost(y) = constant - 2 linear.y + y^T a y, and
/// the volume is preserved if g.y == volume. One formula serves single edges (float) and several at
/// once (Float4, Float8), with the same bits.
template <class F>
struct EdgeQuadric {
  Quadric<F> both;
  Vec3<F> linear;
  F constant;
  F volume;
  Vec3<F> half;  ///< from the midpoint to the target

  /// `edge` runs from the first vertex to the second. `shared` is the sum of the areas times unit
  /// normals of the one or two faces at the edge; it is subtracted because their volume would count
  /// twice. (These faces do count twice in the cost, as in Garland's and Heckbert's sums. In
  /// measurements this is better than counting them once: 1.5 % less RMS distance over sixteen
  /// cases.)
  EdgeQuadric(const Quadric<F>& from, const Quadric<F>& to, const Vec3<F>& shared,
              const Vec3<F>& edge)
      : both(from + to), half(edge * broadcast<F>(0.5F)) {
    both.g = both.g - shared;
    const Vec3<F> of_from = from.times(half);
    const Vec3<F> of_to = to.times(half);
    linear = of_to - of_from;
    constant = dot(half, of_from + of_to);
    // The shared faces contain the edge, so their contribution vanishes.
    volume = dot(to.g - from.g, half);
  }

  F cost(const Vec3<F>& y) const {
    return constant - dot(linear, y) * broadcast<F>(2.0F) + dot(y, both.times(y));
  }
  /// Returns area times squared length of the edge. Clamped at 0: after a much larger face is
  /// subtracted, a quadric may have lost all significant digits.
  F scale() const {
    return greater_of(both.trace(), broadcast<F>(0.0F)) * dot(half, half) * broadcast<F>(4.0F);
  }
  /// Returns the cost that orders the queue until the edge is evaluated exactly: a lower bound
  /// under rounding. Never negative.
  F ranked_cost(const Vec3<F>& y) const {
    const F size = scale();
    return greater_of(cost(y) - size * broadcast<F>(kQuadricNoise), broadcast<F>(0.0F)) +
           size * broadcast<F>(kTieBreak);
  }
};

/// Returns a quick estimate of the ranked cost: half the cost of merging at the midpoint, which is
/// never much below the true cost and seldom much above it. Never negative. Needs neither faces nor
/// a linear solve.
template <class F>
F guessed_cost(const Quadric<F>& from, const Quadric<F>& to, const Vec3<F>& edge) {
  const Quadric<F> both = from + to;
  const F zero = broadcast<F>(0.0F);
  const F size = greater_of(both.trace(), zero) * dot(edge, edge);
  const F beyond_noise = dot(edge, both.times(edge)) - size * broadcast<F>(8.0F * kGuessNoise);
  return greater_of(beyond_noise, zero) * broadcast<F>(0.125F) + size * broadcast<F>(kTieBreak);
}

/// L D L^T factors of a quadric's matrix with `damping` added to its diagonal. Pivots stay at least
/// half the damping, regardless of rounding.
template <class F>
class Factors {
 public:
  Factors(const Quadric<F>& m, F damping) {
    const F one = broadcast<F>(1.0F);
    const F least = damping * broadcast<F>(0.5F);
    d0_ = one / greater_of(m.xx + damping, least);
    l10_ = m.xy * d0_;
    l20_ = m.xz * d0_;
    d1_ = one / greater_of(m.yy + damping - l10_ * m.xy, least);
    const F below = m.yz - l10_ * m.xz;
    l21_ = below * d1_;
    d2_ = one / greater_of(m.zz + damping - l20_ * m.xz - l21_ * below, least);
  }

  Vec3<F> solve(const Vec3<F>& b) const {
    const F y1 = b.y - l10_ * b.x;
    const F y2 = b.z - l20_ * b.x - l21_ * y1;
    const F z = y2 * d2_;
    const F y = y1 * d1_ - l21_ * z;
    return {b.x * d0_ - l10_ * y - l20_ * z, y, z};
  }

 private:
  F d0_, d1_, d2_;
  F l10_, l20_, l21_;
};

/// Returns the volume-preserving position of least cost, as an offset from the midpoint. Never NaN.
///
/// Directions in which the quadric is weak are damped (kPlacementDamping). Volume is preserved only
/// where the surface has a distinct side (g is not small against the area). The vertex stays in the
/// ball whose diameter is the edge; otherwise a tip whose planes all run along it would be placed
/// far off the surface.
/// `area`: the sum of the areas of the faces, which is the trace of a quadric of planes alone.
template <class F>
Vec3<F> best_offset(const EdgeQuadric<F>& edge, const F& area) {
  constexpr float kTiny = 1e-30F;
  constexpr float kHasSide = 0.01F;
  const F tiny = broadcast<F>(kTiny);
  const Factors<F> factors(edge.both, greater_of(area * broadcast<F>(kPlacementDamping), tiny));
  const Vec3<F> free = factors.solve(edge.linear);
  const Vec3<F>& g = edge.both.g;
  const Vec3<F> across = factors.solve(g);
  const F correction = (edge.volume - dot(g, free)) / greater_of(dot(g, across), tiny);
  const F has_side =
      select(dot(g, g) > area * area * broadcast<F>(kHasSide), correction, broadcast<F>(0.0F));
  const Vec3<F> y = free + across * has_side;
  const F reach = dot(edge.half, edge.half);
  const F distance = dot(y, y);
  const F shrink = square_root(reach / greater_of(distance, tiny));
  return y * select(distance > reach, shrink, broadcast<F>(1.0F));
}

template <class F>
Vec3<F> best_offset(const EdgeQuadric<F>& edge) {
  return best_offset(edge, edge.both.trace());
}

/// Returns whether the target is the better of the two ends. The quadratic terms of both are equal,
/// so the sign of the linear term decides.
inline bool is_target_better(const EdgeQuadric<float>& edge) {
  return dot(edge.linear, edge.half) >= 0.0F;
}

}  // namespace mesher::simplify
