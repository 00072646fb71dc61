#include "engine/render/mip_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/parallel.h"

namespace mesher::render {
namespace {

/// Light in 14 bits tells all 256 colors apart.
constexpr std::uint32_t kMostLight = (1U << 14U) - 1;

/// Pixels per task of a parallel loop.
constexpr std::size_t kPixelsAtOnce = std::size_t{1} << 16U;

/// The curve of sRGB (IEC 61966-2-1) in both directions.
struct SrgbTables {
  std::array<std::uint16_t, 256> light{};
  std::array<std::uint8_t, kMostLight + 1> color{};

  SrgbTables() {
    for (std::size_t i = 0; i < light.size(); ++i) {
      const double c = static_cast<double>(i) / 255.0;
      const double l = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
      light[i] = static_cast<std::uint16_t>(std::lround(l * kMostLight));
    }
    for (std::size_t i = 0; i < color.size(); ++i) {
      const double l = static_cast<double>(i) / kMostLight;
      const double c = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
      color[i] = static_cast<std::uint8_t>(std::lround(255.0 * c));
    }
  }
};

const SrgbTables& srgb_tables() {
  static const SrgbTables kTables;
  return kTables;
}

struct NumberAverage {
  std::uint8_t operator()(int /*component*/, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                          std::uint32_t d) const {
    return static_cast<std::uint8_t>((a + b + c + d + 2) / 4);
  }
};

struct ColorAverage {
  const SrgbTables& tables = srgb_tables();
  std::uint8_t operator()(int component, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                          std::uint32_t d) const {
    if (component == 3) return NumberAverage{}(component, a, b, c, d);
    const auto& light = tables.light;
    return tables.color[(light[a] + light[b] + light[c] + light[d] + 2U) / 4];
  }
};

template <class Average>
Image halved(const ImageView& image, const Average& average) {
  Image half{
      .width = std::max(image.width / 2, 1U), .height = std::max(image.height / 2, 1U), .rgba = {}};
  half.rgba.resize(std::size_t{4} * half.width * half.height);
  // A side of one pixel has no second one; the last of an odd side is left out.
  const std::size_t right = image.width > 1 ? 4 : 0;
  const std::size_t rows_at_once = kPixelsAtOnce / half.width + 1;
  parallel_for_each(half.height, rows_at_once, [&](std::uint32_t y) {
    std::uint8_t* out = half.rgba.data() + std::size_t{4} * half.width * y;
    const std::uint8_t* above = image.pixel(0, std::min(2 * y, image.height - 1));
    const std::uint8_t* below = image.pixel(0, std::min(2 * y + 1, image.height - 1));
    for (std::uint32_t x = 0; x < half.width; ++x, above += 8, below += 8) {
      for (int c = 0; c < 4; ++c)
        *out++ = average(c, above[c], above[right + c], below[c], below[right + c]);
    }
  });
  return half;
}

}  // namespace

std::vector<Image> mip_levels(const ImageView& image, bool is_srgb) {
  std::vector<Image> levels;
  ImageView last = image;
  while (last.width > 1 || last.height > 1) {
    levels.push_back(is_srgb ? halved(last, ColorAverage{}) : halved(last, NumberAverage{}));
    last = levels.back();
  }
  return levels;
}

}  // namespace mesher::render
