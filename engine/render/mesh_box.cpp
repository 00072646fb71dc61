#include "engine/render/mesh_box.h"

#include <vector>

#include "engine/core/parallel.h"

namespace mesher::render {
namespace {

/// Adds the position of a vertex and the positions that it or an ancestor had at coarser levels.
void extend_by_positions(Box& box, const Mesh& mesh, const MorphSource& morph, Vertex v) {
  glm::vec3 p = mesh.position(v);
  extend(box, p);
  if (morph.is_empty()) return;
  std::uint32_t head = morph.heads[v.index()];
  while (head != kNoHead) {
    const SplitMorph& split = morph.splits[head >> 1U];
    p -= (head & 1U) != 0 ? split.child_delta : split.parent_delta;
    extend(box, p);
    head = split.previous;
  }
}

Box box_of_positions(const Mesh& mesh, const MorphSource& morph) {
  constexpr std::size_t kChunk = 1U << 14;
  std::vector<Box> parts(chunk_count(mesh.vertex_count(), kChunk));
  parallel_chunks(mesh.vertex_count(), kChunk, [&](std::size_t chunk, IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v)
      extend_by_positions(parts[chunk], mesh, morph, Vertex(static_cast<std::uint32_t>(v)));
  });
  Box box;
  for (const Box& part : parts) {
    extend(box, part.min);
    extend(box, part.max);
  }
  return box;
}

}  // namespace

void MeshBox::update(const Mesh& mesh, const MorphSource& morph, bool is_new_mesh) {
  if (is_new_mesh) *this = {};
  const bool grows = !morph.is_empty();
  const bool is_walked = mesh.vertex_count() <= walked_vertices_;
  const MorphSource walked = is_walked ? MorphSource{} : morph;
  if (mesh.changes().is_whole(GpuArray::position)) {
    if (grows && is_walked) return;  // a level below one that is included already
    const Box now = walked.is_empty() ? bounding_box(mesh) : box_of_positions(mesh, walked);
    if (!grows || box_.is_empty()) {
      box_ = now;
    } else if (!now.is_empty()) {
      extend(box_, now.min);
      extend(box_, now.max);
    }
  } else {
    for (const ChangedRange range :
         mesh.changes().merged(GpuArray::position, 0, mesh.vertex_count())) {
      for (std::uint32_t v = range.begin; v < range.end; ++v)
        extend_by_positions(box_, mesh, walked, Vertex(v));
    }
  }
  if (!grows) {
    walked_vertices_ = 0;
  } else if (!is_walked) {
    walked_vertices_ = mesh.vertex_count();
  }
}

}  // namespace mesher::render
