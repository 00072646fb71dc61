#include "engine/render/gpu_mesh.h"

#include <algorithm>
#include <utility>

#include "engine/core/parallel.h"

namespace mesher::render {
namespace {

constexpr std::uint32_t kClassesPerWord = 16;
constexpr VkBufferUsageFlags kPositionUsage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
constexpr VkBufferUsageFlags kIndexUsage = VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
constexpr std::size_t kWordGrain = 1U << 12;

std::uint32_t class_word(const Mesh& mesh, std::uint32_t word) {
  const std::uint32_t begin = word * kClassesPerWord;
  const std::uint32_t end = std::min(begin + kClassesPerWord, mesh.halfedge_count());
  std::uint32_t packed = 0;
  for (std::uint32_t h = begin; h < end; ++h) {
    const auto edge_class = static_cast<std::uint32_t>(mesh.edge_class(Halfedge(h)));
    packed |= edge_class << 2 * (h - begin);
  }
  return packed;
}

std::uint32_t word_count(std::uint32_t halfedges) {
  return halfedges / kClassesPerWord + (halfedges % kClassesPerWord == 0 ? 0 : 1);
}

template <class Elements>
std::span<const std::byte> bytes_of(const Elements& elements) {
  return std::as_bytes(std::span(elements));
}

/// Returns whether vertices or faces have changed, and not just the sharpness of edges.
bool has_changed_shape(const ChangeLog& changes) {
  return !changes.is_empty(GpuArray::position) || !changes.is_empty(GpuArray::origin);
}

/// Returns the indices at which a list differs from its old version.
ChangeLog differences(const std::vector<Line>& before, const std::vector<Line>& after) {
  ChangeLog log;
  for (std::uint32_t i = 0; i < after.size(); ++i) {
    if (i >= before.size() || before[i] != after[i]) log.note(GpuArray::origin, i);
  }
  return log;
}

}  // namespace

UploadStats GpuMesh::apply(Mesh& mesh, const Settings& settings, const Sources& sources) {
  UploadStats stats;
  const bool is_new = !is_valid_;
  is_valid_ = false;  // until everything has succeeded
  if (is_new) {
    forget_buffers();
    mesh.changes().note_all();
    appearance_.invalidate();
    make_room_for(mesh, sources.morph.splits_to_come());
  }
  const bool is_smaller = mesh.face_count() < face_count_;  // which the log need not tell
  if (!mesh.changes().is_empty() || mesh.vertex_count() != vertex_count_ ||
      mesh.face_count() != face_count_) {
    box_.update(mesh, sources.morph, is_new);
    copy_arrays(mesh, stats);
  }
  normals_.update(mesh, settings,
                  {.corner = sources.corner_normals,
                   .vertex = sources.vertex_normals,
                   .most_vertices = mesh.vertex_count() + sources.morph.splits_to_come(),
                   .can_split = !lines_.creases.empty()},
                  is_new, stats);
  morph_.update(mesh, sources, is_new, stats);
  const bool is_changed = is_new || is_smaller || has_changed_shape(mesh.changes());
  pose_.update(mesh, sources.pose, positions_.address(), is_changed, stats);
  appearance_.update(mesh, settings, sources.appearance, is_changed, stats);
  appearance_.place(surface_block());
  is_valid_ = true;
  mesh.changes().clear();
  for (const Part& part : parts())
    stats.total_bytes += part.bytes;
  stats.total_bytes += appearance_.attribute_bytes();
  return stats;
}

bool GpuMesh::mark(const MarkedEdges& marked) {
  if (marked == marked_) return false;
  std::vector<Line> lines;
  for (const Edge e : marked.selected)
    lines.push_back({Mesh::halfedge(e), 1.0F});
  if (marked.hovered.is_valid()) lines.push_back({Mesh::halfedge(marked.hovered), 1.0F});
  UploadStats not_shown;
  upload_whole(device_, mark_buffer_, bytes_of(lines), 0, not_shown);
  marked_ = marked;
  return true;
}

void GpuMesh::forget_buffers() {
  for (gpu::Buffer* buffer :
       {&positions_, &indices_, &class_buffer_, &crease_buffer_, &boundary_buffer_}) {
    *buffer = {};
  }
  marked_ = {};
}

void GpuMesh::make_room_for(const Mesh& mesh, std::size_t splits) {
  if (splits == 0) return;
  const std::size_t vertices = mesh.vertex_count() + splits;
  const std::size_t halfedges = mesh.halfedge_count() + 6 * splits;
  const std::size_t words = halfedges / kClassesPerWord + 1;
  make_room(device_, positions_, vertices * sizeof(glm::vec3), kPositionUsage);
  make_room(device_, indices_, halfedges * sizeof(Vertex), kIndexUsage);
  make_room(device_, class_buffer_, words * sizeof(std::uint32_t), 0);
}

void GpuMesh::copy_arrays(const Mesh& mesh, UploadStats& stats) {
  const ChangeLog& changes = mesh.changes();
  upload_changes(device_, positions_, bytes_of(mesh.positions()),
                 {changes, GpuArray::position, sizeof(glm::vec3)}, kPositionUsage, stats);
  upload_changes(device_, indices_, bytes_of(mesh.origins()),
                 {changes, GpuArray::origin, sizeof(Vertex)}, kIndexUsage, stats);
  if (changes.is_whole(GpuArray::edge_class)) {
    copy_all_classes(mesh, stats);
  } else {
    copy_changed_classes(mesh, stats);
  }
  vertex_count_ = mesh.vertex_count();
  face_count_ = mesh.face_count();
}

void GpuMesh::copy_all_classes(const Mesh& mesh, UploadStats& stats) {
  classes_.resize(word_count(mesh.halfedge_count()));
  parallel_for(classes_.size(), kWordGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      classes_[i] = class_word(mesh, static_cast<std::uint32_t>(i));
    }
  });
  upload_whole(device_, class_buffer_, bytes_of(classes_), 0, stats);
  lines_ = find_line_edges(mesh);
  upload_whole(device_, crease_buffer_, bytes_of(lines_.creases), 0, stats);
  upload_whole(device_, boundary_buffer_, bytes_of(lines_.boundaries), 0, stats);
}

void GpuMesh::copy_changed_classes(const Mesh& mesh, UploadStats& stats) {
  const std::uint32_t count = mesh.halfedge_count();
  const std::vector<ChangedRange> changed = mesh.changes().merged(GpuArray::edge_class, 0, count);
  classes_.resize(word_count(count));
  ChangeLog words;  // sorts and merges; counts words here
  const auto pack = [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t word = first; word <= last; ++word)
      classes_[word] = class_word(mesh, word);
    words.note(GpuArray::edge_class, first, last - first + 1);
  };
  for (const ChangedRange range : changed)
    pack(range.begin / kClassesPerWord, (range.end - 1) / kClassesPerWord);
  // The last word is zero past the live half-edges, whatever was there before.
  if (count != halfedge_count() && count > 0) pack(word_count(count) - 1, word_count(count) - 1);
  upload_changes(device_, class_buffer_, bytes_of(classes_),
                 {words, GpuArray::edge_class, sizeof(std::uint32_t)}, 0, stats);

  const LineEdges before = lines_;
  update_line_edges(mesh, changed, lines_);
  const auto copy_lines = [&](const std::vector<Line>& old, const std::vector<Line>& now,
                              gpu::Buffer& buffer) {
    upload_changes(device_, buffer, bytes_of(now),
                   {differences(old, now), GpuArray::origin, sizeof(Line)}, 0, stats);
  };
  copy_lines(before.creases, lines_.creases, crease_buffer_);
  copy_lines(before.boundaries, lines_.boundaries, boundary_buffer_);
}

std::array<GpuMesh::Part, 8> GpuMesh::parts() const {
  return {{{&positions_, sizeof(glm::vec3) * vertex_count_},
           {&indices_, sizeof(Vertex) * halfedge_count()},
           {&class_buffer_, bytes_of(classes_).size()},
           {&crease_buffer_, bytes_of(lines_.creases).size()},
           {&boundary_buffer_, bytes_of(lines_.boundaries).size()},
           {&normals_.buffer(), normals_.bytes()},
           {&morph_.heads(), morph_.head_bytes()},
           {&morph_.splits(), morph_.split_bytes()}}};
}

shared::SurfaceBlock GpuMesh::surface_block() const {
  shared::SurfaceBlock block{};
  block.positions = positions_.address();
  block.indices = indices_.address();
  block.classes = class_buffer_.address();
  block.normals = normals_.buffer().address();
  block.pose = pose_.constants();
  if (normals_.mode() == GpuNormals::Mode::vertex) block.flags |= shared::kVertexNormals;
  if (normals_.mode() == GpuNormals::Mode::corner) block.flags |= shared::kCornerNormals;
  return block;
}

std::vector<std::byte> GpuMesh::read_back() const {
  std::vector<std::byte> all;
  for (const Part& part : parts()) {
    const std::vector<std::byte> content = gpu::download(device_, *part.buffer, part.bytes);
    all.insert(all.end(), content.begin(), content.end());
  }
  return all;
}

}  // namespace mesher::render
