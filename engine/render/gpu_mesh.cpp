#include "engine/render/gpu_mesh.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "engine/core/parallel.h"

namespace mesher::render {
namespace {

constexpr std::uint32_t kClassesPerWord = 16;
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

template <class T>
std::span<const std::byte> bytes_of(std::span<const T> elements) {
  return std::as_bytes(elements);
}

}  // namespace

UploadStats GpuMesh::apply(Mesh& mesh, const Settings& settings) {
  UploadStats stats;
  const bool is_new =
      !is_valid_ || mesh.vertex_count() != vertex_count_ || mesh.face_count() != face_count_;
  is_valid_ = false;  // until all of it worked
  if (is_new) {
    copy_whole(mesh, stats);
  } else if (!mesh.changes().is_empty()) {
    copy_changes(mesh, stats);
  }
  normals_.update(mesh, settings, !lines_.creases.empty(), is_new, stats);
  is_valid_ = true;
  mesh.changes().clear();
  stats.total_bytes = total_bytes();
  return stats;
}

void GpuMesh::copy_whole(const Mesh& mesh, UploadStats& stats) {
  vertex_count_ = mesh.vertex_count();
  face_count_ = mesh.face_count();
  box_ = bounding_box(mesh);
  upload_whole(device_, positions_, bytes_of(mesh.positions()), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
               stats);
  upload_whole(device_, indices_, bytes_of(mesh.origins()), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
               stats);
  copy_all_classes(mesh, stats);
}

void GpuMesh::copy_all_classes(const Mesh& mesh, UploadStats& stats) {
  classes_.resize((std::size_t{mesh.halfedge_count()} + kClassesPerWord - 1) / kClassesPerWord);
  parallel_for(classes_.size(), kWordGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      classes_[i] = class_word(mesh, static_cast<std::uint32_t>(i));
    }
  });
  upload_whole(device_, class_buffer_, std::as_bytes(std::span(classes_)), 0, stats);
  lines_ = find_line_edges(mesh);
  copy_lines(stats);
}

void GpuMesh::copy_lines(UploadStats& stats) {
  std::vector<Halfedge> all = lines_.creases;
  all.insert(all.end(), lines_.boundaries.begin(), lines_.boundaries.end());
  upload_whole(device_, line_buffer_, std::as_bytes(std::span(all)), 0, stats);
}

void GpuMesh::copy_changes(const Mesh& mesh, UploadStats& stats) {
  const ChangeLog& changes = mesh.changes();
  if (changes.is_whole(GpuArray::position)) {
    box_ = bounding_box(mesh);
    upload_whole(device_, positions_, bytes_of(mesh.positions()), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                 stats);
  } else {
    const auto ranges = changes.merged(GpuArray::position, worthwhile_gap(sizeof(glm::vec3)));
    for (const ChangedRange range : ranges) {
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        box_.min = glm::min(box_.min, mesh.position(Vertex(i)));
        box_.max = glm::max(box_.max, mesh.position(Vertex(i)));
      }
    }
    upload_ranges(device_, positions_, bytes_of(mesh.positions()), ranges, sizeof(glm::vec3),
                  stats);
  }
  if (changes.is_whole(GpuArray::origin)) {
    upload_whole(device_, indices_, bytes_of(mesh.origins()), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                 stats);
  } else {
    upload_ranges(device_, indices_, bytes_of(mesh.origins()),
                  changes.merged(GpuArray::origin, worthwhile_gap(sizeof(Vertex))), sizeof(Vertex),
                  stats);
  }
  if (changes.is_whole(GpuArray::edge_class)) {
    copy_all_classes(mesh, stats);
  } else {
    copy_changed_classes(mesh, stats);
  }
}

void GpuMesh::copy_changed_classes(const Mesh& mesh, UploadStats& stats) {
  const std::vector<ChangedRange> changed = mesh.changes().merged(GpuArray::edge_class);
  if (changed.empty()) return;
  ChangeLog words;  // sorts and joins; what it counts here are words
  for (const ChangedRange range : changed) {
    const std::uint32_t first = range.begin / kClassesPerWord;
    const std::uint32_t last = (range.end - 1) / kClassesPerWord;
    for (std::uint32_t word = first; word <= last; ++word)
      classes_[word] = class_word(mesh, word);
    words.note(GpuArray::edge_class, first, last - first + 1);
  }
  constexpr std::size_t kWord = sizeof(std::uint32_t);
  upload_ranges(device_, class_buffer_, std::as_bytes(std::span(classes_)),
                words.merged(GpuArray::edge_class, worthwhile_gap(kWord)), kWord, stats);
  LineEdges before = lines_;
  update_line_edges(mesh, changed, lines_);
  if (lines_ != before) copy_lines(stats);
}

std::uint64_t GpuMesh::total_bytes() const {
  return positions_.size() + indices_.size() + class_buffer_.size() + line_buffer_.size() +
         normals_.buffer().size();
}

std::vector<std::byte> GpuMesh::read_back() const {
  std::vector<std::byte> all;
  for (const gpu::Buffer* buffer :
       {&positions_, &indices_, &class_buffer_, &line_buffer_, &normals_.buffer()}) {
    const std::vector<std::byte> part = gpu::download(device_, *buffer, buffer->size());
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace mesher::render
