#include "engine/analysis/uv_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "engine/core/array.h"

namespace mesher::analysis {
namespace {

constexpr std::int64_t kMostSide = 1024;
constexpr std::int64_t kLeastSide = 16;
/// Texels that may be counted, and cleared, before the grid gets coarser.
constexpr double kMostWork = 1 << 28;
/// Positions are rounded to this fraction of a texel, so that edges are tested exactly and a texel
/// on an edge counts for one of its faces.
constexpr std::int64_t kParts = 256;
constexpr std::int64_t kHalf = kParts / 2;
/// Farthest texture coordinate that is counted.
constexpr double kFarthest = 1 << 20;
constexpr std::uint32_t kFacesPerCheck = 4096;

using Point = std::array<std::int64_t, 2>;
using UvTriangle = std::array<glm::dvec2, 3>;
using ByImage = std::map<std::uint64_t, std::vector<UvTriangle>>;

bool is_counted(const UvTriangle& uv) {
  const glm::dvec2 low = glm::min(glm::min(uv[0], uv[1]), uv[2]);
  const glm::dvec2 high = glm::max(glm::max(uv[0], uv[1]), uv[2]);
  return low.x >= -kFarthest && low.y >= -kFarthest && high.x <= kFarthest && high.y <= kFarthest &&
         high.x - low.x <= kMostTiles && high.y - low.y <= kMostTiles;
}

ByImage triangles_by_image(const AttributedSurface& surface) {
  ByImage triangles;
  const UvLayers uvs(surface);
  for (std::uint32_t f = 0; f < surface.mesh.face_count(); ++f) {
    const auto uv = uvs.corners(Face(f));
    if (uv && is_counted(*uv)) triangles[surface.texture(Face(f)).image].push_back(*uv);
  }
  return triangles;
}

/// Returns about how many steps counting takes at the finest grid: per texel, and per row.
glm::dvec2 work_of(const ByImage& all) {
  glm::dvec2 work(0.0);
  for (const auto& [image, triangles] : all) {
    for (const auto& [a, b, c] : triangles) {
      const glm::dvec2 u = b - a;
      const glm::dvec2 v = c - a;
      work.x += 0.5 * std::abs(u.x * v.y - u.y * v.x) * kMostSide * kMostSide;
      work.y += (std::max({a.y, b.y, c.y}) - std::min({a.y, b.y, c.y})) * kMostSide;
    }
  }
  work.x += static_cast<double>(all.size() * kMostSide * kMostSide);
  return work;
}

std::int64_t choose_side(const ByImage& first, const ByImage& second) {
  const glm::dvec2 work = work_of(first) + work_of(second);
  std::int64_t side = kMostSide;
  for (double scale = 1.0; side > kLeastSide; side /= 2, scale *= 0.5) {
    if (work.x * scale * scale + work.y * scale <= kMostWork) break;
  }
  return side;
}

std::int64_t floor_divided(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a % b < 0) != (b < 0) ? 1 : 0);
}

/// Counts of faces at the texels of one image.
class Coverage {
 public:
  explicit Coverage(std::int64_t side)
      : side_(side), count_(static_cast<std::size_t>(side * side)) {}

  void clear() { std::ranges::fill(count_, std::uint16_t{0}); }
  std::span<const std::uint16_t> counts() const { return count_; }

  void add(const UvTriangle& uv) {
    std::array<Point, 3> p;
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::dvec2 at = uv[c] * static_cast<double>(side_ * kParts);
      p[c] = {std::llround(at.x), std::llround(at.y)};
    }
    const std::int64_t area =
        (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    if (area == 0) return;
    if (area < 0) std::swap(p[1], p[2]);
    const auto [low, high] = std::minmax({p[0][1], p[1][1], p[2][1]});
    const std::int64_t first = floor_divided(low - kHalf, kParts);
    const std::int64_t last = floor_divided(high - kHalf, kParts);
    for (std::int64_t row = first; row <= last; ++row)
      add_row(p, row);
  }

 private:
  /// Counts the texels of a row whose centers are inside. Pre: the corners run counterclockwise.
  void add_row(const std::array<Point, 3>& p, std::int64_t row) {
    std::int64_t first = floor_divided(std::min({p[0][0], p[1][0], p[2][0]}), kParts) - 1;
    std::int64_t last = floor_divided(std::max({p[0][0], p[1][0], p[2][0]}), kParts) + 1;
    const std::int64_t y = row * kParts + kHalf;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point& a = p[i];
      const Point& b = p[(i + 1) % 3];
      const std::int64_t dx = b[0] - a[0];
      const std::int64_t dy = b[1] - a[1];
      // The side of the edge on which column x is: start + x * step; above 0 is inside. A center on
      // an edge belongs to the face on one side of it only.
      const bool owns_edge = dy < 0 || (dy == 0 && dx < 0);
      const std::int64_t least = owns_edge ? 0 : 1;
      const std::int64_t start = dx * (y - a[1]) - dy * (kHalf - a[0]);
      const std::int64_t step = -dy * kParts;
      if (step > 0) {
        first = std::max(first, -floor_divided(start - least, step));
      } else if (step < 0) {
        last = std::min(last, floor_divided(start - least, -step));
      } else if (start < least) {
        return;
      }
    }
    const std::int64_t line = (row - floor_divided(row, side_) * side_) * side_;
    for (std::int64_t x = first; x <= last; ++x) {
      std::uint16_t& count =
          count_[static_cast<std::size_t>(line + x - floor_divided(x, side_) * side_)];
      if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
    }
  }

  std::int64_t side_;
  Array<std::uint16_t> count_;
};

/// Texels that are covered, and how many times they are covered again.
struct TexelSums {
  std::uint64_t covered = 0;
  std::uint64_t again = 0;

  void add(std::uint64_t times) {
    covered += times > 0 ? 1 : 0;
    again += times > 1 ? times - 1 : 0;
  }
  double share(std::uint64_t part) const {
    return covered > 0 ? static_cast<double>(part) / static_cast<double>(covered) : 0.0;
  }
};

}  // namespace

UvOverlap uv_overlap(const AttributedSurface& original, const AttributedSurface& second,
                     Progress* progress) {
  const ByImage of_original = triangles_by_image(original);
  const ByImage of_second = triangles_by_image(second);
  const std::int64_t side = choose_side(of_original, of_second);
  Coverage before(side);
  Coverage after(side);
  const auto count = [&](const ByImage& all, std::uint64_t image, Coverage& coverage) {
    coverage.clear();
    const auto found = all.find(image);
    if (found == all.end()) return;
    std::uint32_t done = 0;
    for (const UvTriangle& triangle : found->second) {
      if (done++ % kFacesPerCheck == 0) check_cancelled(progress);
      coverage.add(triangle);
    }
  };
  TexelSums sums_before;
  TexelSums sums_after;
  std::uint64_t added = 0;
  std::set<std::uint64_t> images;
  for (const ByImage* all : {&of_original, &of_second}) {
    for (const auto& [image, triangles] : *all)
      images.insert(image);
  }
  for (const std::uint64_t image : images) {
    count(of_original, image, before);
    count(of_second, image, after);
    for (std::size_t i = 0; i < before.counts().size(); ++i) {
      const std::uint64_t old = before.counts()[i];
      const std::uint64_t now = after.counts()[i];
      sums_before.add(old);
      sums_after.add(now);
      const std::uint64_t usual = std::max<std::uint64_t>(old, 1);
      added += now > usual ? now - usual : 0;
    }
  }
  return {.original = sums_before.share(sums_before.again),
          .second = sums_after.share(sums_after.again),
          .added = sums_after.share(added),
          .is_measured = sums_after.covered > 0};
}

}  // namespace mesher::analysis
