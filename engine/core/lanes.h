#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace mesher {

/// Four floats processed at once. Each lane rounds like a single float, so a formula written once
/// for `float`, `Float4` and `Float8` yields the same bits for all.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

/// Eight floats as two groups of four, so that two divisions can overlap.
struct Float8 {
  Float4 low{};
  Float4 high{};
  friend Float8 operator+(const Float8& a, const Float8& b) {
    return {a.low + b.low, a.high + b.high};
  }
  friend Float8 operator-(const Float8& a, const Float8& b) {
    return {a.low - b.low, a.high - b.high};
  }
  friend Float8 operator*(const Float8& a, const Float8& b) {
    return {a.low * b.low, a.high * b.high};
  }
  friend Float8 operator/(const Float8& a, const Float8& b) {
    return {a.low / b.low, a.high / b.high};
  }
};
struct Mask8 {
  Int4 low;
  Int4 high;
};
inline Mask8 operator>(const Float8& a, const Float8& b) {
  return {a.low > b.low, a.high > b.high};
}
inline Mask8 operator>=(const Float8& a, const Float8& b) {
  return {a.low >= b.low, a.high >= b.high};
}

/// Returns `yes` where `condition` holds, otherwise `no`. Comparisons of Float4 yield the
/// condition.
inline float select(bool condition, float yes, float no) {
  return condition ? yes : no;
}
template <class Mask>
Float4 select(Mask condition, Float4 yes, Float4 no) {
  return condition ? yes : no;
}

inline Int4 select(Int4 condition, Int4 yes, Int4 no) {
  return condition ? yes : no;
}

inline Float8 select(const Mask8& condition, const Float8& yes, const Float8& no) {
  return {condition.low ? yes.low : no.low, condition.high ? yes.high : no.high};
}

template <class F>
F greater_of(F a, F b) {
  return select(a > b, a, b);
}

template <class F>
F smaller_of(F a, F b) {
  return select(a > b, b, a);
}

inline float square_root(float x) {
  return std::sqrt(x);
}
inline Float4 square_root(Float4 x) {
#if defined(__SSE__)
  return _mm_sqrt_ps(x);
#else
  return Float4{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

inline Float8 square_root(const Float8& x) {
  return {square_root(x.low), square_root(x.high)};
}

template <class F>
F broadcast(float x) {
  if constexpr (std::is_same_v<F, Float8>) {
    return {Float4{} + x, Float4{} + x};
  } else {
    return F{} + x;
  }
}

inline float sum_of(Float4 lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

inline Float4 to_float(Int4 lanes) {
  return __builtin_convertvector(lanes, Float4);
}

/// The condition that holds in every lane.
inline constexpr Int4 kAlways{-1, -1, -1, -1};

/// Returns whether the condition holds in any lane.
inline bool any(Int4 condition) {
  using Long2 = std::int64_t __attribute__((vector_size(16)));
  Long2 halves;
  __builtin_memcpy(&halves, &condition, sizeof halves);
  return (halves[0] | halves[1]) != 0;
}

/// Returns a bit for each lane in which the condition holds, the first lane's lowest.
inline std::uint32_t bits_of(Int4 condition) {
#if defined(__SSE__)
  Float4 lanes;
  __builtin_memcpy(&lanes, &condition, sizeof lanes);
  return static_cast<std::uint32_t>(_mm_movemask_ps(lanes));
#else
  std::uint32_t bits = 0;
  for (std::uint32_t lane = 0; lane < 4; ++lane)
    bits |= condition[lane] != 0 ? 1U << lane : 0U;
  return bits;
#endif
}

inline Float4 load4(const float* from) {
  Float4 lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline void store4(float* to, Float4 lanes) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}

/// Transposes a 4 x 4 matrix.
inline void transpose(Float4& a, Float4& b, Float4& c, Float4& d) {
  const Float4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Float4 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Float4 cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Float4 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// A 3D vector of F (float, Float4 or Float8).
template <class F>
struct Vec3 {
  F x, y, z;
  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const Vec3& a, F s) { return {a.x * s, a.y * s, a.z * s}; }
};

inline Vec3<Float8> pair(const Vec3<Float4>& low, const Vec3<Float4>& high) {
  return {{low.x, high.x}, {low.y, high.y}, {low.z, high.z}};
}

template <class F>
F dot(const Vec3<F>& a, const Vec3<F>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class F>
Vec3<F> cross(const Vec3<F>& a, const Vec3<F>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace mesher
