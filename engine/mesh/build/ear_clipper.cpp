#include "engine/mesh/build/ear_clipper.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace mesher {
namespace {

// The budget of point tests per corner. Ordinary outlines need a few.
constexpr std::uint64_t kTestsPerCorner = 400;

}  // namespace

EarClipper::EarClipper(std::span<const glm::vec3> polygon)
    : polygon_(polygon),
      point_(polygon.size()),
      prev_(polygon.size()),
      next_(polygon.size()),
      version_(polygon.size(), 0),
      is_alive_(polygon.size(), true),
      first_blocked_(polygon.size(), kNone),
      remaining_(static_cast<std::uint32_t>(polygon.size())),
      budget_(kTestsPerCorner * polygon.size()) {
  for (std::uint32_t i = 0; i < remaining_; ++i) {
    prev_[i] = i == 0 ? remaining_ - 1 : i - 1;
    next_[i] = i + 1 == remaining_ ? 0 : i + 1;
  }
  project();
  build_grid();
}

// Dropping the axis of the largest normal component leaves the other coordinates unchanged, so that
// differences of floats stay exact in double.
void EarClipper::project() {
  glm::dvec3 normal(0.0);  // Newell: robust for any outline
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const glm::dvec3 a = polygon_[i];
    const glm::dvec3 b = polygon_[next_[i]];
    normal +=
        glm::dvec3((a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x), (a.x - b.x) * (a.y + b.y));
  }
  const glm::dvec3 size = glm::abs(normal);
  int axis = 2;
  if (size.x > size.y && size.x > size.z) {
    axis = 0;
  } else if (size.y > size.z) {
    axis = 1;
  }
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const bool is_mirrored = normal[axis] < 0.0;
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    const glm::dvec3 p = polygon_[i];
    point_[i] = is_mirrored ? glm::dvec2(p[v], p[u]) : glm::dvec2(p[u], p[v]);
  }
}

double EarClipper::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const glm::dvec2 ab = point_[b] - point_[a];
  const glm::dvec2 ac = point_[c] - point_[a];
  return ab.x * ac.y - ab.y * ac.x;
}

bool EarClipper::spend(std::uint64_t cost) {
  const bool is_affordable = cost <= budget_;
  budget_ -= is_affordable ? cost : budget_;
  return is_affordable;
}

std::array<std::uint32_t, 2> EarClipper::cell_of(const glm::dvec2& p) const {
  const glm::dvec2 cell = (p - grid_min_) / cell_size_;
  const double last = grid_side_ - 1;
  return {static_cast<std::uint32_t>(std::clamp(cell.x, 0.0, last)),
          static_cast<std::uint32_t>(std::clamp(cell.y, 0.0, last))};
}

void EarClipper::build_grid() {
  std::vector<std::uint32_t> reflex;
  for (std::uint32_t i = 0; i < remaining_; ++i) {
    if (!is_convex(i)) reflex.push_back(i);
  }
  glm::dvec2 grid_max = grid_min_ = point_[0];
  for (const glm::dvec2& p : point_) {
    grid_min_ = glm::min(grid_min_, p);
    grid_max = glm::max(grid_max, p);
  }
  grid_side_ = std::max(1U, static_cast<std::uint32_t>(std::sqrt(double(reflex.size()) / 2.0)));
  cell_size_ = (grid_max - grid_min_) / static_cast<double>(grid_side_);
  cell_size_ = glm::max(cell_size_, glm::dvec2(1e-300));
  cell_start_.assign(std::size_t{grid_side_} * grid_side_ + 1, 0);
  for (const std::uint32_t i : reflex)
    ++cell_start_[cell_index(i) + 1];
  std::partial_sum(cell_start_.begin(), cell_start_.end(), cell_start_.begin());
  cell_corner_.resize(reflex.size());
  cell_end_.assign(cell_start_.begin(), cell_start_.end() - 1);
  slot_.assign(polygon_.size(), kNone);
  for (const std::uint32_t i : reflex) {
    slot_[i] = cell_end_[cell_index(i)]++;
    cell_corner_[slot_[i]] = i;
  }
  blockers_ = reflex.size();
}

std::size_t EarClipper::cell_index(std::uint32_t i) const {
  const auto [x, y] = cell_of(point_[i]);
  return std::size_t{y} * grid_side_ + x;
}

// A corner at the position of one of the triangle's own corners does not block it: outlines that
// touch themselves (a hole joined by a bridge) are legal.
bool EarClipper::blocks(std::uint32_t i, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  if (i == a || i == b || i == c) return false;
  const glm::dvec2& p = point_[i];
  if (p == point_[a] || p == point_[b] || p == point_[c]) return false;
  return turn(a, b, i) >= 0.0 && turn(b, c, i) >= 0.0 && turn(c, a, i) >= 0.0;
}

// Visits only the cells that the triangle can touch, row by row: long thin ears are common (stars,
// gears).
std::uint32_t EarClipper::find_blocker(std::uint32_t i) {
  if (blockers_ == 0) return kNone;
  const std::uint32_t a = prev_[i];
  const std::uint32_t c = next_[i];
  const std::array<glm::dvec2, 3> t{point_[a], point_[i], point_[c]};
  const std::uint32_t first_row = cell_of(glm::min(glm::min(t[0], t[1]), t[2]))[1];
  const std::uint32_t last_row = cell_of(glm::max(glm::max(t[0], t[1]), t[2]))[1];
  for (std::uint32_t y = first_row; y <= last_row; ++y) {
    const auto [x0, x1] = columns_in_row(t, y);
    for (std::size_t cell = std::size_t{y} * grid_side_ + x0;
         cell <= std::size_t{y} * grid_side_ + x1; ++cell) {
      if (!spend(1 + cell_end_[cell] - cell_start_[cell])) return kNone;
      for (std::uint32_t k = cell_start_[cell]; k < cell_end_[cell]; ++k) {
        if (blocks(cell_corner_[k], a, i, c)) return cell_corner_[k];
      }
    }
  }
  return kNone;
}

std::array<std::uint32_t, 2> EarClipper::columns_in_row(const std::array<glm::dvec2, 3>& t,
                                                        std::uint32_t row) const {
  // One extra cell on each side, so that rounding cannot lose a blocker.
  const double low = grid_min_.y + (row - 1.0) * cell_size_.y;
  const double high = grid_min_.y + (row + 2.0) * cell_size_.y;
  double x_min = std::numeric_limits<double>::infinity();
  double x_max = -x_min;
  const auto cover = [&](double x) {
    x_min = std::min(x_min, x);
    x_max = std::max(x_max, x);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2& p = t[k];
    const glm::dvec2& q = t[(k + 1) % 3];
    if (p.y >= low && p.y <= high) cover(p.x);
    for (const double y : {low, high}) {
      if ((p.y < y) != (q.y < y)) cover(p.x + (q.x - p.x) * ((y - p.y) / (q.y - p.y)));
    }
  }
  const std::uint32_t x0 = cell_of({x_min - cell_size_.x, 0.0})[0];
  return {x0, std::max(x0, cell_of({x_max + cell_size_.x, 0.0})[0])};
}

/// Returns 1 for an equilateral triangle, 0 for one without area, in 3D.
double EarClipper::shape(std::uint32_t i) const {
  const glm::dvec3 a = polygon_[prev_[i]];
  const glm::dvec3 b = polygon_[i];
  const glm::dvec3 c = polygon_[next_[i]];
  const double edges = glm::dot(b - a, b - a) + glm::dot(c - b, c - b) + glm::dot(a - c, a - c);
  if (!(edges > 0.0)) return 0.0;
  return 2.0 * std::sqrt(3.0) * glm::length(glm::cross(b - a, c - a)) / edges;
}

void EarClipper::push(std::uint32_t i) {
  ++version_[i];
  if (!is_convex(i)) return;
  candidates_.push({shape(i), i, version_[i]});
  stop_blocking(i);
}

void EarClipper::clip(std::uint32_t i, std::vector<Triangle>& triangles) {
  const std::uint32_t a = prev_[i];
  const std::uint32_t c = next_[i];
  triangles.push_back({a, i, c});
  next_[a] = c;
  prev_[c] = a;
  is_alive_[i] = false;
  some_corner_ = c;
  --remaining_;
  push(a);
  push(c);
  stop_blocking(i);
}

// A clipped or newly convex corner blocks nothing: it leaves the grid, and the candidates that it
// blocked are retried.
void EarClipper::stop_blocking(std::uint32_t i) {
  if (slot_[i] == kNone) return;
  const std::uint32_t last = --cell_end_[cell_index(i)];
  cell_corner_[slot_[i]] = cell_corner_[last];
  slot_[cell_corner_[last]] = slot_[i];
  slot_[i] = kNone;
  --blockers_;
  for (std::uint32_t w = first_blocked_[i]; w != kNone; w = blocked_[w].next) {
    if (is_alive_[blocked_[w].corner]) push(blocked_[w].corner);
  }
}

// The outline has no ear, so it crosses or touches itself. Clipping any convex corner, or else any
// corner, makes progress.
std::uint32_t EarClipper::best_fallback_corner() const {
  std::uint32_t best = some_corner_;
  double best_shape = -1.0;
  std::uint32_t i = some_corner_;
  do {
    const double s = is_convex(i) ? 1.0 + shape(i) : 0.0;
    if (s > best_shape) {
      best_shape = s;
      best = i;
    }
    i = next_[i];
  } while (i != some_corner_);
  return best;
}

void EarClipper::run(std::vector<Triangle>& triangles) {
  for (std::uint32_t i = 0; i < remaining_; ++i)
    push(i);
  while (remaining_ > 3) {
    if (candidates_.empty()) {
      clip(spend(remaining_) ? best_fallback_corner() : some_corner_, triangles);
      continue;
    }
    const Candidate top = candidates_.top();
    candidates_.pop();
    const std::uint32_t i = top.corner;
    if (!is_alive_[i] || version_[i] != top.version) continue;
    const std::uint32_t blocker = find_blocker(i);
    if (blocker == kNone) {
      clip(i, triangles);
    } else {
      blocked_.push_back({i, first_blocked_[blocker]});
      first_blocked_[blocker] = static_cast<std::uint32_t>(blocked_.size() - 1);
    }
  }
  triangles.push_back({prev_[some_corner_], some_corner_, next_[some_corner_]});
}

}  // namespace mesher
