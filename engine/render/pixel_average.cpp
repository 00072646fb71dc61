#include "engine/render/pixel_average.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/parallel.h"

namespace mesher::render {
namespace {

/// Steps of linear light in the table of encoded values. The darkest values that sRGB distinguishes
/// are 20 steps apart.
constexpr std::uint32_t kLightSteps = 65535;

/// The sRGB transfer function of bytes, both ways.
struct ByteCurve {
  std::array<float, 256> light;     ///< in kLightSteps
  std::vector<std::uint8_t> bytes;  ///< by light, rounded to a step

  ByteCurve() : bytes(kLightSteps + 1) {
    for (std::size_t i = 0; i < light.size(); ++i) {
      const double c = static_cast<double>(i) / 255.0;
      const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
      light[i] = static_cast<float>(kLightSteps * linear);
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const double l = static_cast<double>(i) / kLightSteps;
      const double c = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
      bytes[i] = static_cast<std::uint8_t>(std::lround(255.0 * c));
    }
  }

  std::uint8_t encode(float value) const {
    return bytes[static_cast<std::size_t>(std::min(value + 0.5F, float{kLightSteps}))];
  }
};

}  // namespace

Image average_pixels(const Image& drawn, unsigned n) {
  static const ByteCurve kCurve;
  MESHER_ASSERT(n > 0 && drawn.width % n == 0 && drawn.height % n == 0);
  Image result{.width = drawn.width / n, .height = drawn.height / n, .rgba = {}};
  result.rgba.resize(std::size_t{4} * result.width * result.height);
  constexpr std::size_t kRowGrain = 16;
  parallel_for_each(result.height, kRowGrain, [&](std::uint32_t y) {
    std::uint8_t* out = result.rgba.data() + std::size_t{4} * y * result.width;
    for (std::uint32_t x = 0; x < result.width; ++x, out += 4) {
      std::array<float, 3> light{};
      std::uint32_t alpha = 0;
      for (unsigned row = 0; row < n; ++row) {
        const std::uint8_t* p = drawn.pixel(n * x, n * y + row);
        for (unsigned column = 0; column < n; ++column, p += 4) {
          for (std::size_t c = 0; c < light.size(); ++c)
            light[c] += kCurve.light[p[c]];
          alpha += p[3];
        }
      }
      if (alpha == 0) {
        std::fill(out, out + 4, std::uint8_t{0});
        continue;
      }
      // The sum of premultiplied light over the sum of alpha: the count of pixels cancels.
      const float inverse_alpha = 255.0F / static_cast<float>(alpha);
      for (std::size_t c = 0; c < light.size(); ++c)
        out[c] = kCurve.encode(inverse_alpha * light[c]);
      out[3] = static_cast<std::uint8_t>((alpha + n * n / 2) / (n * n));
    }
  });
  return result;
}

}  // namespace mesher::render
