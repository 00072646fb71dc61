#include "engine/progressive/detail_range.h"

#include <algorithm>
#include <cmath>

namespace mesher::progressive {

double DetailRange::growing(double time) const {
  return std::max(1.0, geomorph_range * (base_vertices + time));
}

// The inverse of `grown`, which is linear on either side of where the range gets wider than 1.
double DetailRange::time_of(double grown) const {
  const double wide = (grown - 1.0 + geomorph_range * base_vertices) / (1.0 - geomorph_range);
  return std::max({0.0, grown, wide});
}

double DetailRange::position_of(double time) const {
  const double whole = std::log1p(end() / base_vertices);
  return whole > 0.0 ? std::clamp(std::log1p(time / base_vertices) / whole, 0.0, 1.0) : 1.0;
}

double DetailRange::time_at(double position) const {
  const double last = end();
  if (position >= 1.0) return last;  // without rounding
  const double whole = std::log1p(last / base_vertices);
  return std::clamp(base_vertices * std::expm1(std::max(position, 0.0) * whole), 0.0, last);
}

std::uint32_t DetailRange::level(double time) const {
  return static_cast<std::uint32_t>(std::clamp(std::ceil(time), 0.0, double(splits)));
}

GeomorphTime DetailRange::growth(double time) const {
  if (geomorph_range <= 0.0 || time >= end()) return GeomorphTime::done();
  return GeomorphTime::continuous(time, growing(time));
}

}  // namespace mesher::progressive
