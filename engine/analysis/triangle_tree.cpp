#include "engine/analysis/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "engine/analysis/space_curve.h"
#include "engine/core/parallel.h"

namespace mesher::analysis {
namespace {

constexpr std::size_t kGrain = 1U << 12U;
constexpr float kMost = std::numeric_limits<float>::max();

using Float4 = float __attribute__((vector_size(16)));

Float4 load4(const float* from) {
  Float4 four;
  __builtin_memcpy(&four, from, sizeof(four));
  return four;
}

double squared_length(const glm::dvec3& v) {
  return glm::dot(v, v);
}

double squared_distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double length = squared_length(ab);
  const double t = length > 0.0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
  return squared_length(p - (a + t * ab));
}

double squared_distance_to_sides(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
  return std::min({squared_distance_to_segment(p, t[0], t[1]),
                   squared_distance_to_segment(p, t[1], t[2]),
                   squared_distance_to_segment(p, t[2], t[0])});
}

}  // namespace

double squared_distance(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
  // The plane of a triangle thinner than this is too inaccurate.
  constexpr double kThin = 1e-12;
  const glm::dvec3 ab = t[1] - t[0];
  const glm::dvec3 ac = t[2] - t[0];
  const glm::dvec3 ap = p - t[0];
  const double d1 = glm::dot(ab, ap);
  const double d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return squared_length(ap);
  const glm::dvec3 bp = p - t[1];
  const double d3 = glm::dot(ab, bp);
  const double d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return squared_length(bp);
  const glm::dvec3 cp = p - t[2];
  const double d5 = glm::dot(ab, cp);
  const double d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return squared_length(cp);
  // The areas of the triangles that the point forms with the sides, times the area of the whole.
  const double vc = d1 * d4 - d3 * d2;
  const double vb = d5 * d2 - d1 * d6;
  const double va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc;
  if (sum <= kThin * squared_length(ab) * squared_length(ac)) {
    return squared_distance_to_sides(p, t);
  }
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return squared_length(ap - (d1 / (d1 - d3)) * ab);
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return squared_length(ap - (d2 / (d2 - d6)) * ac);
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    return squared_length(bp - ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t[2] - t[1]));
  }
  return squared_length(ap - (vb / sum) * ab - (vc / sum) * ac);
}

TriangleTree::TriangleTree(const Mesh& mesh, TriangleOrder order) {
  MESHER_ASSERT(mesh.face_count() > 0);
  const std::uint32_t faces = mesh.face_count();
  if (order == TriangleOrder::any) {
    order_ = faces_along_curve(mesh);
  } else {
    order_.resize(faces);
    parallel_for_each(faces, kGrain, [&](std::uint32_t i) { order_[i] = i; });
  }
  copy_corners(mesh);
  leaves_ = (faces + kWidth - 1) / kWidth;
  std::uint32_t nodes = leaves_;
  for (std::uint32_t level = leaves_; level > 1; nodes += level)
    level = (level + kWidth - 1) / kWidth;
  nodes_.resize(nodes);
  children_.resize(nodes - leaves_);
  build_leaves();
  for (std::uint32_t begin = 0, end = leaves_; end - begin > 1;) {
    const std::uint32_t above = end + (end - begin + kWidth - 1) / kWidth;
    build_level(begin, end, end);
    begin = std::exchange(end, above);
  }
}

void TriangleTree::copy_corners(const Mesh& mesh) {
  corners_.resize(order_.size());
  index_in_order_.resize(order_.size());
  parallel_for_each(order_.size(), kGrain, [&](std::uint32_t i) {
    for (std::uint32_t c = 0; c < 3; ++c)
      corners_[i][c] = mesh.position(mesh.origin(Mesh::halfedge(Face(order_[i]), c)));
    index_in_order_[order_[i]] = i;
  });
}

void TriangleTree::build_leaves() {
  parallel_for_each(leaves_, kGrain / kWidth, [&](std::uint32_t leaf) {
    Node& node = nodes_[leaf];
    for (std::uint32_t i = 0; i < kWidth; ++i) {
      // Lanes past the last triangle repeat it and are never visited.
      const auto index = std::min<std::size_t>(leaf * kWidth + i, corners_.size() - 1);
      const auto& [a, b, c] = corners_[index];
      const glm::vec3 min = glm::min(glm::min(a, b), c);
      const glm::vec3 max = glm::max(glm::max(a, b), c);
      for (int axis = 0; axis < 3; ++axis) {
        node.min[axis][i] = min[axis];
        node.max[axis][i] = max[axis];
      }
    }
  });
}

/// Builds the level above nodes `begin` to `end`, starting at node `to`.
void TriangleTree::build_level(std::uint32_t begin, std::uint32_t end, std::uint32_t to) {
  const std::uint32_t count = (end - begin + kWidth - 1) / kWidth;
  parallel_for_each(count, kGrain / kWidth, [&](std::uint32_t n) {
    Node& node = nodes_[to + n];
    const std::uint32_t first = begin + n * kWidth;
    children_[to + n - leaves_] = {first, std::min(kWidth, end - first)};
    for (std::uint32_t i = 0; i < kWidth; ++i) {
      const Node& child = nodes_[std::min(first + i, end - 1)];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.min[axis][i] = *std::min_element(child.min[axis].begin(), child.min[axis].end());
        node.max[axis][i] = *std::max_element(child.max[axis].begin(), child.max[axis].end());
      }
    }
  });
}

/// The state of one query. Boxes are tested in float, four at once, without ever rounding up: the
/// point's coordinates are rounded away from the box.
class TriangleTree::Query {
 public:
  explicit Query(const glm::dvec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto rounded = static_cast<float>(std::clamp(p[axis], -double{kMost}, double{kMost}));
      const bool is_above = double{rounded} > p[axis];
      above_[axis] = is_above ? rounded : std::nextafter(rounded, kMost);
      below_[axis] = is_above ? std::nextafter(rounded, -kMost) : rounded;
    }
  }

  bool is_done() const { return size_ == 0; }
  std::uint64_t take() { return stack_[--size_]; }
  static std::uint32_t node(std::uint64_t entry) { return static_cast<std::uint32_t>(entry); }
  static double bound_of(std::uint64_t entry) {
    return bounded(std::bit_cast<float>(static_cast<std::uint32_t>(entry >> 32U)));
  }
  /// Returns the bound for the box of child `i` of the node measured last.
  double bound(std::size_t i) const { return bounded(squared_[i]); }

  /// Computes the squared distances to the boxes of a node's children, at most slightly too small.
  void measure(const Node& node) {
    constexpr float kRoundingOfSum = 1.0F - 0x1p-20F;
    for (std::size_t half = 0; half < kWidth; half += 4) {
      Float4 sum{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Float4 before = load4(&node.min[axis][half]) - above_[axis];
        const Float4 after = below_[axis] - load4(&node.max[axis][half]);
        Float4 outside = before > after ? before : after;
        outside = outside > 0.0F ? outside : Float4{};
        sum += outside * outside;
      }
      sum *= kRoundingOfSum;
      __builtin_memcpy(&squared_[half], &sum, sizeof(sum));
    }
  }

  void push(std::uint32_t node, float squared = 0.0F) {
    stack_[size_++] = std::uint64_t{std::bit_cast<std::uint32_t>(squared)} << 32U | node;
  }
  /// Pushes the measured children nearer than `least`, the nearest on top.
  void push(const Children& children, double least) {
    const std::size_t begin = size_;
    for (std::uint32_t i = 0; i < children.count; ++i) {
      if (bound(i) >= least) continue;
      push(children.first + i, squared_[i]);
      for (std::size_t k = size_ - 1; k > begin && stack_[k] > stack_[k - 1]; --k)
        std::swap(stack_[k], stack_[k - 1]);
    }
  }

 private:
  // A tree of 2^32 triangles has 11 levels, each with at most seven nodes left on the stack.
  static constexpr std::size_t kStack = 96;

  // A square that overflows only means that the distance is large.
  static double bounded(float squared) { return double{std::min(squared, kMost)}; }

  std::array<float, 3> above_;
  std::array<float, 3> below_;
  alignas(16) std::array<float, kWidth> squared_;
  std::array<std::uint64_t, kStack> stack_;  ///< the bits of the bound, which is not negative, then
                                             ///< the node
  std::size_t size_ = 0;
};

TriangleTree::Nearest TriangleTree::nearest_beyond(const glm::dvec3& p, Face hint,
                                                   double enough) const {
  std::uint32_t best = index_in_order_[hint.index()];
  double least = squared_distance(p, corners(best));
  if (least <= enough) return {hint, least};
  Query query(p);
  query.push(static_cast<std::uint32_t>(nodes_.size() - 1));
  while (!query.is_done() && least > enough) {
    const std::uint64_t entry = query.take();
    if (Query::bound_of(entry) >= least) continue;
    const std::uint32_t node = Query::node(entry);
    query.measure(nodes_[node]);
    if (node >= leaves_) {
      query.push(children_[node - leaves_], least);
      continue;
    }
    const std::uint32_t first = node * kWidth;
    const auto count = std::min(kWidth, static_cast<std::uint32_t>(corners_.size()) - first);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (query.bound(i) >= least) continue;
      const double d = squared_distance(p, corners(first + i));
      if (d < least) {
        least = d;
        best = first + i;
      }
    }
  }
  return {Face(order_[best]), least};
}

void TriangleTree::within(const glm::dvec3& p, double squared, std::size_t most,
                          std::vector<Face>& found) const {
  Query query(p);
  query.push(static_cast<std::uint32_t>(nodes_.size() - 1));
  // The bounds of boxes must be below this.
  const double beyond = std::nextafter(squared, std::numeric_limits<double>::infinity());
  while (!query.is_done() && found.size() < most) {
    const std::uint32_t node = Query::node(query.take());
    query.measure(nodes_[node]);
    if (node >= leaves_) {
      query.push(children_[node - leaves_], beyond);
      continue;
    }
    const std::uint32_t first = node * kWidth;
    const auto count = std::min(kWidth, static_cast<std::uint32_t>(corners_.size()) - first);
    for (std::uint32_t i = 0; i < count && found.size() < most; ++i) {
      if (query.bound(i) <= squared && squared_distance(p, corners(first + i)) <= squared)
        found.push_back(Face(order_[first + i]));
    }
  }
}

}  // namespace mesher::analysis
