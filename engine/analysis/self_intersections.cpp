#include "engine/analysis/self_intersections.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>

#include "engine/analysis/triangle_pair.h"
#include "engine/core/array.h"
#include "engine/core/parallel.h"
#include "engine/mesh/statistics.h"

namespace mesher::analysis {
namespace {

using Corners = std::array<glm::vec3, 3>;

ExactTriangle exact(const Corners& corners) {
  return {corners[0], corners[1], corners[2]};
}

Box box_of(const Corners& c) {
  return {glm::min(glm::min(c[0], c[1]), c[2]), glm::max(glm::max(c[0], c[1]), c[2])};
}

Box join(const Box& a, const Box& b) {
  return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

bool do_overlap(const Box& a, const Box& b) {
  // Combines the six comparisons without branches, which would be unpredictable.
  return (static_cast<unsigned>(a.min.x <= b.max.x) & static_cast<unsigned>(b.min.x <= a.max.x) &
          static_cast<unsigned>(a.min.y <= b.max.y) & static_cast<unsigned>(b.min.y <= a.max.y) &
          static_cast<unsigned>(a.min.z <= b.max.z) & static_cast<unsigned>(b.min.z <= a.max.z)) !=
         0;
}

std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16U) & 0x030000FFU;
  x = (x | x << 8U) & 0x0300F00FU;
  x = (x | x << 4U) & 0x030C30C3U;
  return (x | x << 2U) & 0x09249249U;
}

/// The faces with area that are not removed, sorted along a Morton curve, and a binary tree of
/// boxes over them. Neighbors on the curve are siblings.
class SortedFaces {
 public:
  explicit SortedFaces(const Mesh& mesh) {
    sort(mesh);
    corners_.resize(order_.size());
    boxes_.resize(order_.size());
    parallel_for_each(order_.size(), 4096, [&](std::uint32_t i) {
      corners_[i] = corners(mesh, Face(static_cast<std::uint32_t>(order_[i])));
      boxes_[i] = box_of(corners_[i]);
    });
    build_tree();
  }

  std::size_t leaf_count() const { return levels_.empty() ? 0 : levels_.front().size(); }

  /// Calls `visit(face, face)` for each intersecting pair whose earlier face on the curve is in the
  /// leaf.
  template <class Visit>
  void visit_pairs(std::size_t leaf, const Visit& visit) const {
    struct Node {
      std::size_t level;
      std::size_t index;
    };
    std::array<Node, 2 * std::numeric_limits<std::size_t>::digits> stack;
    std::size_t size = 0;
    stack[size++] = {levels_.size() - 1, 0};
    const Box& box = levels_.front()[leaf];
    while (size > 0) {
      const auto [level, index] = stack[--size];
      const bool is_before = ((index + 1) << level) <= leaf;
      if (is_before || !do_overlap(levels_[level][index], box)) continue;
      if (level == 0) {
        visit_leaves(leaf, index, visit);
        continue;
      }
      if (2 * index + 1 < levels_[level - 1].size()) stack[size++] = {level - 1, 2 * index + 1};
      stack[size++] = {level - 1, 2 * index};
    }
  }

 private:
  static constexpr std::size_t kLeafFaces = 8;

  static Corners corners(const Mesh& mesh, Face f) {
    Corners result;
    for (std::uint32_t c = 0; c < 3; ++c)
      result[c] = mesh.position(mesh.origin(Mesh::halfedge(f, c)));
    return result;
  }

  void sort(const Mesh& mesh) {
    Box all{glm::vec3(std::numeric_limits<float>::max()),
            glm::vec3(std::numeric_limits<float>::lowest())};
    for (const Vertex v : mesh.origins()) {
      if (v.is_valid()) all = join(all, {mesh.position(v), mesh.position(v)});
    }
    const glm::dvec3 min(all.min);
    const glm::dvec3 size = glm::dvec3(all.max) - min;
    const double scale = 1023.0 / std::max({size.x, size.y, size.z, 0x1p-149});
    order_.resize(mesh.face_count());
    parallel_for_each(mesh.face_count(), 4096, [&](std::uint32_t i) {
      order_[i] = kLeftOut;
      if (!mesh.origin(Mesh::halfedge(Face(i))).is_valid()) return;
      const Corners c = corners(mesh, Face(i));
      const Box box = box_of(c);
      const glm::dvec3 middle = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
      const auto cell = glm::uvec3(scale * (middle - min));
      const std::uint64_t code = spread(cell.x) | spread(cell.y) << 1U | spread(cell.z) << 2U;
      if (!is_degenerate(exact(c))) order_[i] = code << 32U | i;
    });
    std::erase(order_, kLeftOut);
    std::sort(order_.begin(), order_.end());
  }

  void build_tree() {
    if (order_.empty()) return;
    levels_.emplace_back(chunk_count(order_.size(), kLeafFaces));
    parallel_for_each(leaf_count(), 1024, [&](std::uint32_t leaf) {
      const auto [begin, end] = faces(leaf);
      Box box = boxes_[begin];
      for (std::size_t i = begin + 1; i < end; ++i)
        box = join(box, boxes_[i]);
      levels_.front()[leaf] = box;
    });
    while (levels_.back().size() > 1) {
      const Array<Box>& below = levels_.back();
      Array<Box> level(chunk_count(below.size(), 2));
      for (std::size_t i = 0; i < level.size(); ++i)
        level[i] = join(below[2 * i], below[std::min(2 * i + 1, below.size() - 1)]);
      levels_.push_back(std::move(level));
    }
  }

  IndexRange faces(std::size_t leaf) const {
    return {kLeafFaces * leaf, std::min(kLeafFaces * (leaf + 1), order_.size())};
  }
  Face face(std::size_t i) const { return Face(static_cast<std::uint32_t>(order_[i])); }

  template <class Visit>
  void visit_leaves(std::size_t leaf, std::size_t other, const Visit& visit) const {
    for (std::size_t i = faces(leaf).begin; i < faces(leaf).end; ++i) {
      const Box& box = boxes_[i];
      if (!do_overlap(box, levels_.front()[other])) continue;
      for (std::size_t k = std::max(i + 1, faces(other).begin); k < faces(other).end; ++k) {
        if (!do_overlap(box, boxes_[k])) continue;
        if (do_intersect(exact(corners_[i]), exact(corners_[k]))) visit(face(i), face(k));
      }
    }
  }

  static constexpr std::uint64_t kLeftOut = ~std::uint64_t{0};

  Array<std::uint64_t> order_;      ///< Morton code in the upper half, face in the lower
  Array<Corners> corners_;          ///< in the order of order_
  Array<Box> boxes_;                ///< in the order of order_
  std::vector<Array<Box>> levels_;  ///< from leaves to the root
};

constexpr std::size_t kLeavesPerChunk = 128;

}  // namespace

std::uint64_t count_self_intersections(const Mesh& mesh, Progress* progress) {
  const SortedFaces faces(mesh);
  std::vector<std::uint64_t> counts(chunk_count(faces.leaf_count(), kLeavesPerChunk), 0);
  parallel_chunks(faces.leaf_count(), kLeavesPerChunk, progress,
                  [&](std::size_t chunk, IndexRange leaves) {
                    for (std::size_t leaf = leaves.begin; leaf < leaves.end; ++leaf)
                      faces.visit_pairs(leaf, [&](Face, Face) { ++counts[chunk]; });
                  });
  std::uint64_t total = 0;
  for (const std::uint64_t count : counts)
    total += count;
  return total;
}

std::vector<FacePair> self_intersections(const Mesh& mesh, Progress* progress) {
  const SortedFaces faces(mesh);
  std::vector<std::vector<FacePair>> found(chunk_count(faces.leaf_count(), kLeavesPerChunk));
  parallel_chunks(faces.leaf_count(), kLeavesPerChunk, progress,
                  [&](std::size_t chunk, IndexRange leaves) {
                    for (std::size_t leaf = leaves.begin; leaf < leaves.end; ++leaf) {
                      faces.visit_pairs(leaf, [&](Face a, Face b) {
                        found[chunk].push_back({std::min(a, b), std::max(a, b)});
                      });
                    }
                  });
  std::vector<FacePair> pairs;
  for (const std::vector<FacePair>& some : found)
    pairs.insert(pairs.end(), some.begin(), some.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace mesher::analysis
