#include "engine/analysis/triangle_tree.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace mesher {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
// Halving 2^32 triangles takes 32 levels; each leaves one node waiting.
constexpr std::size_t kStack = 64;

double squared_length(const glm::dvec3& v) {
  return glm::dot(v, v);
}

double squared_distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double length = squared_length(ab);
  const double t = length > 0.0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
  return squared_length(p - (a + t * ab));
}

}  // namespace

double squared_distance(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double area = squared_length(normal);
  bool is_above = area > 0.0;
  for (std::size_t i = 0; i < 3 && is_above; ++i) {
    const glm::dvec3& a = t[i];
    is_above = glm::dot(glm::cross(t[(i + 1) % 3] - a, p - a), normal) >= 0.0;
  }
  if (is_above) {
    const double height = glm::dot(p - t[0], normal);
    return height * height / area;
  }
  return std::min({squared_distance_to_segment(p, t[0], t[1]),
                   squared_distance_to_segment(p, t[1], t[2]),
                   squared_distance_to_segment(p, t[2], t[0])});
}

TriangleTree::TriangleTree(const Mesh& mesh)
    : corners_(mesh.face_count()), order_(mesh.face_count()) {
  MESHER_ASSERT(mesh.face_count() > 0);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      corners_[f][c] = mesh.position(mesh.origin(Mesh::halfedge(Face(f), c)));
    }
  }
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.emplace_back();
  build(0, 0, mesh.face_count());
}

TriangleTree::Box TriangleTree::box_of(std::uint32_t begin, std::uint32_t end) const {
  Box box{corners_[order_[begin]][0], corners_[order_[begin]][0]};
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const glm::vec3& p : corners_[order_[i]]) {
      box.min = glm::min(box.min, p);
      box.max = glm::max(box.max, p);
    }
  }
  return box;
}

// Halves by number along the longest side, so that the depth is bounded whatever the mesh.
void TriangleTree::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  nodes_[node].box = box_of(begin, end);
  if (end - begin <= kLeafTriangles) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  const glm::vec3 size = nodes_[node].box.max - nodes_[node].box.min;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto center = [&](std::uint32_t f) {
    const auto& t = corners_[f];
    return std::pair(double(t[0][axis]) + t[1][axis] + t[2][axis], f);
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return center(a) < center(b); });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_[node].count = 0;
  nodes_.resize(nodes_.size() + 2);
  build(child, begin, middle);
  build(child + 1, middle, end);
}

std::array<glm::dvec3, 3> TriangleTree::triangle(Face f) const {
  const auto& t = corners_[f.index()];
  return {t[0], t[1], t[2]};
}

double TriangleTree::squared_distance_to(const Box& box, const glm::dvec3& p) {
  const glm::dvec3 outside =
      glm::max(glm::max(glm::dvec3(box.min) - p, p - glm::dvec3(box.max)), glm::dvec3(0.0));
  return squared_length(outside);
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& p, Face hint) const {
  Nearest best{hint, squared_distance(p, triangle(hint))};
  struct Waiting {
    std::uint32_t node;
    double bound;
  };
  std::array<Waiting, kStack> stack;
  std::size_t size = 0;
  stack[size++] = {0, squared_distance_to(nodes_[0].box, p)};
  while (size > 0) {
    const Waiting top = stack[--size];
    if (top.bound >= best.squared_distance) continue;
    const Node& node = nodes_[top.node];
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const Face f(order_[node.first + i]);
      const double d = squared_distance(p, triangle(f));
      if (d < best.squared_distance) best = {f, d};
    }
    if (node.count > 0) continue;
    Waiting near{node.first, squared_distance_to(nodes_[node.first].box, p)};
    Waiting far{node.first + 1, squared_distance_to(nodes_[node.first + 1].box, p)};
    if (far.bound < near.bound) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

}  // namespace mesher
