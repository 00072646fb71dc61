#include "engine/progressive/geomorph.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "engine/mesh/normals.h"
#include "engine/mesh/packed_normal.h"

namespace mesher::progressive {
namespace {

constexpr std::uint32_t kSplitsBetweenReports = 1U << 16;
constexpr std::size_t kFacesBetweenReports = std::size_t{1} << 16;
// Weights of stages, measured with 0.1 and 1.4 million faces on two cores.
/// Times of extending the chains of splits, and of finding their normals.
constexpr double kGeomorphWeights[] = {0.02, 0.98};
/// Times of unit normals, and of the areas around vertices.
constexpr double kAreaNormalWeights[] = {0.85, 0.15};
/// Times of refining to full detail, of its normals, of returning, and of those of the splits.
constexpr double kNormalWeights[] = {0.03, 0.89, 0.03, 0.05};

/// Returns vertex normals, each as long as the area that the vertex represents.
Array<glm::vec3> area_normals(const Mesh& mesh, Progress* progress) {
  Stages stages(progress, kAreaNormalWeights);
  stages.next();
  Array<glm::vec3> normals = vertex_normals(mesh, NormalWeight::angle, progress);
  stages.next();
  Array<float> area(mesh.vertex_count());
  std::fill(area.begin(), area.end(), 0.0F);
  const auto add_face = [&](std::uint32_t f) {
    const auto corner = [&](std::uint32_t c) { return mesh.origin(Halfedge(3 * f + c)); };
    const glm::vec3& a = mesh.position(corner(0));
    const float twice =
        glm::length(glm::cross(mesh.position(corner(1)) - a, mesh.position(corner(2)) - a));
    for (std::uint32_t c = 0; c < 3; ++c)
      area[corner(c).index()] += twice;
  };
  ordered_chunks(mesh.face_count(), kFacesBetweenReports, progress, [&](IndexRange range) {
    for (auto f = static_cast<std::uint32_t>(range.begin); f < range.end; ++f)
      add_face(f);
  });
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    normals[v] *= area[v];
  return normals;
}

}  // namespace

Geomorph::Geomorph(ProgressiveMesh& mesh, Progress* progress) {
  Stages stages(progress, kGeomorphWeights);
  stages.next();
  extend(mesh);
  check_cancelled(progress);
  follow(mesh);
  stages.next();
  find_normals(mesh, progress);
}

void Geomorph::extend(const ProgressiveMesh& mesh) {
  normals_.clear();
  const auto first = static_cast<std::uint32_t>(splits_.size());
  const std::uint32_t base = mesh.base_vertex_count();
  if (first == 0) {
    top_heads_.assign(base, kNoHead);
    heads_.assign(base, kNoHead);
    level_ = 0;
  }
  splits_.resize(mesh.split_count());
  top_heads_.resize(base + std::size_t{mesh.split_count()});
  for (std::uint32_t i = first; i < mesh.split_count(); ++i) {
    const VertexSplit& split = mesh.splits()[i];
    std::uint32_t& head = top_heads_[split.parent.index()];
    splits_[i] = {.parent_delta = split.fine_position - split.coarse_position,
                  .previous = head,
                  .child_delta = split.child_position - split.coarse_position,
                  .coarse_normal = 0,
                  .parent_normal = 0,
                  .child_normal = 0};
    head = 2 * i;
    top_heads_[base + std::size_t{i}] = 2 * i + 1;
  }
}

void Geomorph::find_normals(ProgressiveMesh& mesh, Progress* progress) {
  Stages stages(progress, kNormalWeights);
  stages.next();
  const std::uint32_t level = mesh.level();
  go_to_level(mesh, mesh.split_count(), progress);
  stages.next();
  Array<glm::vec3> sums = area_normals(mesh.mesh(), progress);
  check_cancelled(progress);
  Array<std::uint32_t> packed(sums.size());
  std::transform(sums.begin(), sums.end(), packed.begin(), encode_normal);
  stages.next();
  go_to_level(mesh, level, progress);
  stages.next();
  const auto all = static_cast<std::uint32_t>(splits_.size());
  for (std::uint32_t i = all; i-- > 0;) {
    const std::uint32_t parent = mesh.splits()[i].parent.index();
    const std::uint32_t child = mesh.child(i).index();
    splits_[i].parent_normal = packed[parent];
    splits_[i].child_normal = packed[child];
    sums[parent] += sums[child];
    splits_[i].coarse_normal = packed[parent] = encode_normal(sums[parent]);
    if (i % kSplitsBetweenReports == 0) {
      report(progress, 1.0F - static_cast<float>(i) / static_cast<float>(all));
    }
  }
  // Start with the base's normals and refine to the current level.
  packed.resize(mesh.base_vertex_count());
  normals_ = std::move(packed);
  normals_.resize(heads_.size());
  for (std::uint32_t i = 0; i < level_; ++i) {
    normals_[mesh.splits()[i].parent.index()] = splits_[i].parent_normal;
    normals_[mesh.child(i).index()] = splits_[i].child_normal;
  }
}

void Geomorph::refine(const ProgressiveMesh& mesh, std::uint32_t split) {
  const std::uint32_t parent = mesh.splits()[split].parent.index();
  const std::uint32_t child = mesh.child(split).index();
  heads_[parent] = 2 * split;
  heads_[child] = 2 * split + 1;
  if (normals_.empty()) return;
  normals_[parent] = splits_[split].parent_normal;
  normals_[child] = splits_[split].child_normal;
}

void Geomorph::coarsen(const ProgressiveMesh& mesh, std::uint32_t split) {
  const std::uint32_t parent = mesh.splits()[split].parent.index();
  heads_[parent] = splits_[split].previous;
  if (!normals_.empty()) normals_[parent] = splits_[split].coarse_normal;
}

void Geomorph::follow(const ProgressiveMesh& mesh) {
  const std::uint32_t level = mesh.level();
  const std::size_t vertices = mesh.base_vertex_count() + std::size_t{level};
  if (level > level_) {
    heads_.resize(vertices);
    if (!normals_.empty()) normals_.resize(vertices);
  }
  for (; level_ < level; ++level_)
    refine(mesh, level_);
  for (; level_ > level; --level_)
    coarsen(mesh, level_ - 1);
  heads_.resize(vertices);
  if (!normals_.empty()) normals_.resize(vertices);
}

}  // namespace mesher::progressive
