#pragma once

#include <cstring>
#include <glm/vec3.hpp>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace mesher::subdivide {

/// A position in one SIMD register. Each coordinate rounds like a separate float.
class Point {
 public:
  Point() : lanes_{} {}
  explicit Point(const glm::vec3& p) {
#if defined(__SSE2__)
    double xy;
    std::memcpy(&xy, &p.x, sizeof xy);
    lanes_ = reinterpret_cast<Lanes>(_mm_movelh_ps(_mm_castpd_ps(_mm_set_sd(xy)), _mm_set_ss(p.z)));
#else
    lanes_ = Lanes{p.x, p.y, p.z, 0.0F};
#endif
  }

  void store(glm::vec3& p) const {
#if defined(__SSE2__)
    const double xy = _mm_cvtsd_f64(reinterpret_cast<__m128d>(lanes_));
    std::memcpy(&p.x, &xy, sizeof xy);
    p.z = lanes_[2];
#else
    p = {lanes_[0], lanes_[1], lanes_[2]};
#endif
  }

  friend Point operator+(Point a, Point b) {
    return Point(a.lanes_ + b.lanes_);
  }
  friend Point operator*(float s, Point p) {
    return Point(s * p.lanes_);
  }

 private:
  using Lanes = float __attribute__((vector_size(16)));
  explicit Point(Lanes lanes) : lanes_(lanes) {}
  Lanes lanes_;
};

}  // namespace mesher::subdivide
