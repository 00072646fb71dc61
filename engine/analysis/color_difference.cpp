#include "engine/analysis/color_difference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

#include "engine/analysis/sample_values.h"

namespace mesher::analysis {
namespace {

/// IEC 61966-2-1.
double light_of_srgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Returns the angle of a color's hue in [0, 2 pi).
double hue(double a, double b) {
  if (a == 0.0 && b == 0.0) return 0.0;
  const double angle = std::atan2(b, a);
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

/// Vertex colors in L*a*b*.
class LabColors {
 public:
  explicit LabColors(const AttributedSurface& surface)
      : layer_(surface, *surface.attributes.find(color_type().name)) {}

  glm::dvec3 at(const SurfacePoint& point) const {
    const AttributeValue value = layer_.at(point);
    glm::dvec3 color(value[0], value[1], value[2]);
    for (int c = 0; c < 3; ++c) {
      color[c] = std::clamp(color[c], 0.0, 1.0);
      if (!layer_.type().is_linear) color[c] = light_of_srgb(color[c]);
    }
    return lab_of(color);
  }

 private:
  SurfaceLayer layer_;
};

}  // namespace

glm::dvec3 lab_of(const glm::dvec3& linear) {
  constexpr double kWhite[] = {0.95047, 1.0, 1.08883};
  const double xyz[] = {0.4124564 * linear.x + 0.3575761 * linear.y + 0.1804375 * linear.z,
                        0.2126729 * linear.x + 0.7151522 * linear.y + 0.0721750 * linear.z,
                        0.0193339 * linear.x + 0.1191920 * linear.y + 0.9503041 * linear.z};
  const auto f = [&](int i) {
    constexpr double kStep = 6.0 / 29.0;
    const double t = xyz[i] / kWhite[i];
    return t > kStep * kStep * kStep ? std::cbrt(t) : t / (3.0 * kStep * kStep) + 4.0 / 29.0;
  };
  return {116.0 * f(1) - 16.0, 500.0 * (f(0) - f(1)), 200.0 * (f(1) - f(2))};
}

double delta_e_76(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(a - b);
}

double delta_e_2000(const glm::dvec3& a, const glm::dvec3& b) {
  constexpr double kPi = std::numbers::pi;
  const auto seventh = [](double x) { return std::pow(x, 7.0); };
  const auto saturation = [&](double chroma) {
    return std::sqrt(seventh(chroma) / (seventh(chroma) + seventh(25.0)));
  };
  const double mean_c = 0.5 * (std::hypot(a.y, a.z) + std::hypot(b.y, b.z));
  const double g = 0.5 * (1.0 - saturation(mean_c));
  const double a1 = (1.0 + g) * a.y;
  const double a2 = (1.0 + g) * b.y;
  const double c1 = std::hypot(a1, a.z);
  const double c2 = std::hypot(a2, b.z);
  const double h1 = hue(a1, a.z);
  const double h2 = hue(a2, b.z);
  const bool is_gray = c1 * c2 == 0.0;
  double dh = h2 - h1;
  double mean_h = 0.5 * (h1 + h2);
  if (is_gray) {
    dh = 0.0;
    mean_h = h1 + h2;
  } else if (std::abs(dh) > kPi) {
    dh += dh > 0.0 ? -2.0 * kPi : 2.0 * kPi;
    mean_h += mean_h < kPi ? kPi : -kPi;
  }
  const double dl = b.x - a.x;
  const double dc = c2 - c1;
  const double d_hue = 2.0 * std::sqrt(c1 * c2) * std::sin(0.5 * dh);
  const double mean_l = 0.5 * (a.x + b.x) - 50.0;
  const double mean_c1 = 0.5 * (c1 + c2);
  const double t = 1.0 - 0.17 * std::cos(mean_h - glm::radians(30.0)) +
                   0.24 * std::cos(2.0 * mean_h) +
                   0.32 * std::cos(3.0 * mean_h + glm::radians(6.0)) -
                   0.20 * std::cos(4.0 * mean_h - glm::radians(63.0));
  const double bend = (glm::degrees(mean_h) - 275.0) / 25.0;
  const double rotation =
      -2.0 * saturation(mean_c1) * std::sin(2.0 * glm::radians(30.0) * std::exp(-bend * bend));
  const double l = dl / (1.0 + 0.015 * mean_l * mean_l / std::sqrt(20.0 + mean_l * mean_l));
  const double c = dc / (1.0 + 0.045 * mean_c1);
  const double h = d_hue / (1.0 + 0.015 * mean_c1 * t);
  return std::sqrt(std::max(l * l + c * c + h * h + rotation * c * h, 0.0));
}

bool has_vertex_colors(const AttributedSurface& surface) {
  const AttributeLayer* const layer = surface.attributes.find(color_type().name);
  return layer != nullptr && layer->type().components >= 3;
}

ColorDifference color_difference(const AttributedSurface& from, const AttributedSurface& to,
                                 const SurfaceMatches& matches) {
  const LabColors here(from);
  const LabColors there(to);
  const auto best = [&](std::size_t i) {
    const glm::dvec3 color = here.at(matches.sample(i));
    glm::dvec3 nearest(std::numeric_limits<double>::infinity());
    for (const SurfacePoint& candidate : matches.candidates(i)) {
      const glm::dvec3 other = there.at(candidate);
      if (delta_e_76(color, other) < delta_e_76(color, nearest)) nearest = other;
    }
    return std::pair(color, nearest);
  };
  return {.cie76 = Spread(values_at_samples(matches.count(),
                                            [&](std::size_t i) {
                                              const auto [a, b] = best(i);
                                              return delta_e_76(a, b);
                                            })),
          .ciede2000 = Spread(values_at_samples(matches.count(), [&](std::size_t i) {
            const auto [a, b] = best(i);
            return delta_e_2000(a, b);
          }))};
}

}  // namespace mesher::analysis
