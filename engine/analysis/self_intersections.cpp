#include "engine/analysis/self_intersections.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>

#include "engine/analysis/eight_faces.h"
#include "engine/analysis/fan_graph.h"
#include "engine/analysis/triangle_pair.h"
#include "engine/core/array.h"
#include "engine/core/parallel.h"
#include "engine/mesh/statistics.h"

namespace mesher::analysis {
namespace {

Box join(const Box& a, const Box& b) {
  return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16U) & 0x030000FFU;
  x = (x | x << 8U) & 0x0300F00FU;
  x = (x | x << 4U) & 0x030C30C3U;
  return (x | x << 2U) & 0x09249249U;
}

/// The faces with area that are not removed, sorted along a Morton curve in leaves of eight, and a
/// tree of boxes over the leaves. Neighbors on the curve are siblings.
class SortedFaces {
 public:
  explicit SortedFaces(const Mesh& mesh) {
    sort(mesh);
    const Array<std::uint8_t> is_graph = find_graphs(mesh);
    leaves_.resize(chunk_count(order_.size(), kLeafFaces));
    parallel_for_each(leaves_.size(), 512, [&](std::uint32_t leaf) {
      const auto [begin, end] = faces(leaf);
      leaves_[leaf].clear();
      for (std::size_t i = begin; i < end; ++i)
        leaves_[leaf].set(i - begin, mesh, face(i), is_graph);
    });
    build_tree();
  }

  std::size_t leaf_count() const { return leaves_.size(); }

  /// Calls `visit(face, face)` for each intersecting pair whose earlier face on the curve is in the
  /// leaf.
  template <class Visit>
  void visit_pairs(std::size_t leaf, const Visit& visit) const {
    struct Node {
      std::size_t level;
      std::size_t index;
    };
    std::array<Node, kFanOut * std::numeric_limits<std::size_t>::digits> stack;
    std::size_t size = 0;
    stack[size++] = {levels_.size() - 1, 0};
    const Box& box = leaves_[leaf].boxes().all();
    while (size > 0) {
      const auto [level, index] = stack[--size];
      // Children before the leaf have had their turn.
      const std::size_t own = leaf >> (kBitsOfFanOut * level);
      std::uint32_t near = levels_[level][index].overlapping(box);
      if (own > kFanOut * index) near &= ~0U << (own - kFanOut * index);
      for (; near != 0; near &= near - 1) {
        const std::size_t child =
            kFanOut * index + static_cast<std::size_t>(std::countr_zero(near));
        if (level == 0) {
          visit_leaves(leaf, child, visit);
        } else {
          stack[size++] = {level - 1, child};
        }
      }
    }
  }

 private:
  static constexpr std::size_t kLeafFaces = EightFaces::kFaces;
  static constexpr std::size_t kBitsOfFanOut = 3;
  static constexpr std::size_t kFanOut = std::size_t{1} << kBitsOfFanOut;

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
      const ExactTriangle t = exact_triangle(mesh, Face(i));
      const glm::dvec3 middle =
          0.5 * (glm::min(glm::min(t[0], t[1]), t[2]) + glm::max(glm::max(t[0], t[1]), t[2]));
      const auto cell = glm::uvec3(scale * (middle - min));
      const std::uint64_t code = spread(cell.x) | spread(cell.y) << 1U | spread(cell.z) << 2U;
      if (!is_degenerate(t)) order_[i] = code << 32U | i;
    });
    std::erase(order_, kLeftOut);
    std::sort(order_.begin(), order_.end());
  }

  void build_tree() {
    if (leaves_.empty()) return;
    levels_.push_back(
        groups_of(leaves_.size(), [&](std::size_t leaf) { return leaves_[leaf].boxes().all(); }));
    while (levels_.back().size() > 1) {
      const Array<EightBoxes>& below = levels_.back();
      levels_.push_back(groups_of(below.size(), [&](std::size_t i) { return below[i].all(); }));
    }
  }

  template <class BoxOf>
  static Array<EightBoxes> groups_of(std::size_t count, const BoxOf& box_of) {
    Array<EightBoxes> groups(chunk_count(count, kFanOut));
    for (EightBoxes& group : groups)
      group.clear();
    for (std::size_t i = 0; i < count; ++i)
      groups[i / kFanOut].set(i % kFanOut, box_of(i));
    return groups;
  }

  IndexRange faces(std::size_t leaf) const {
    return {kLeafFaces * leaf, std::min(kLeafFaces * (leaf + 1), order_.size())};
  }
  Face face(std::size_t i) const { return Face(static_cast<std::uint32_t>(order_[i])); }

  template <class Visit>
  void visit_leaves(std::size_t leaf, std::size_t other, const Visit& visit) const {
    const EightFaces& ours = leaves_[leaf];
    const EightFaces& theirs = leaves_[other];
    for (std::uint32_t near = ours.boxes().overlapping(theirs.boxes().all()); near != 0;
         near &= near - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(near));
      std::uint32_t bits = theirs.may_intersect(ours, i);
      // In the same leaf, each pair counts at its first face.
      if (leaf == other) bits &= ~1U << i;
      for (; bits != 0; bits &= bits - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(bits));
        if (do_intersect(ours.triangle(i), theirs.triangle(k)))
          visit(face(kLeafFaces * leaf + i), face(kLeafFaces * other + k));
      }
    }
  }

  static constexpr std::uint64_t kLeftOut = ~std::uint64_t{0};

  Array<std::uint64_t> order_;             ///< Morton code in the upper half, face in the lower
  Array<EightFaces> leaves_;               ///< in the order of order_
  std::vector<Array<EightBoxes>> levels_;  ///< boxes of the leaves, of eight leaves each, ...
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
