#include "engine/render/section.h"

#include <algorithm>
#include <cmath>

#include "engine/core/assert.h"

namespace mesher::render {
namespace {

/// A section along one axis.
struct Interval {
  std::uint32_t log_factor = 0;
  int center = 0;  ///< from the middle of the picture, in units of half a section
  float begin = 0.0F;
  float length = 0.0F;
};

Interval interval_of(std::uint32_t picture, std::int32_t corner, std::uint32_t size,
                     std::uint32_t largest) {
  MESHER_ASSERT(largest > 0);
  Interval interval;
  while ((largest << interval.log_factor) < picture)
    ++interval.log_factor;
  MESHER_ASSERT(interval.log_factor == 0 || size <= largest / 4);
  const int factor = 1 << interval.log_factor;
  const double half = 0.5 * picture / factor;
  const double middle = corner + 0.5 * size - 0.5 * picture;
  interval.center =
      std::clamp(static_cast<int>(std::lround(middle / half)), 1 - factor, factor - 1);
  interval.begin = static_cast<float>(0.5 * picture + (interval.center - 1) * half - corner);
  interval.length = static_cast<float>(2.0 * half);
  return interval;
}

}  // namespace

Section section_of(const PicturePart& part, VkExtent2D size, VkExtent2D device_limit) {
  const Interval x = interval_of(part.picture.width, part.corner.x, size.width,
                                 std::min(device_limit.width, part.largest_viewport));
  const Interval y = interval_of(part.picture.height, part.corner.y, size.height,
                                 std::min(device_limit.height, part.largest_viewport));
  const auto byte = [](int center) { return static_cast<std::uint32_t>(center) & 0xFFU; };
  return {.viewport = {x.begin, y.begin, x.length, y.length, 0.0F, 1.0F},
          .code = x.log_factor | y.log_factor << 4 | byte(x.center) << 8 | byte(y.center) << 16};
}

}  // namespace mesher::render
