#include "engine/progressive/progressive_mesh.h"

#include <algorithm>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/outgoing.h"
#include "engine/progressive/opened_arrays.h"
#include "engine/progressive/parent_fan.h"
#include "engine/progressive/split_appender.h"
#include "engine/progressive/split_step.h"

namespace mesher::progressive {
namespace {

// A longer way is recorded as a change of everything: beyond about this many ranges, one large copy
// is cheaper than many small ones.
constexpr std::uint32_t kLongWay = 4096;

}  // namespace

ProgressiveMesh::ProgressiveMesh(Mesh&& base)
    : base_vertices_(base.vertex_count()),
      base_faces_(base.face_count()),
      full_faces_(base.face_count()) {
  MeshArrays arrays = MeshArrays::take(std::move(base));
  arrays.bow_tie_copies.clear();
  fill_outgoing(arrays);
  has_sharp_base_ = std::any_of(arrays.sharpness.begin(), arrays.sharpness.end(),
                                [](float sharpness) { return sharpness > 0.0F; });
  mesh_ = std::move(arrays).finish();
}

std::uint32_t ProgressiveMesh::level_for_faces(std::uint32_t faces) const {
  if (faces >= full_faces_) return split_count();
  const auto after = std::upper_bound(
      splits_.begin(), splits_.end(), faces,
      [](std::uint32_t count, const VertexSplit& split) { return count < split.first_face; });
  return after == splits_.begin() ? 0 : static_cast<std::uint32_t>(after - splits_.begin()) - 1;
}

SplitStep ProgressiveMesh::step(std::uint32_t i) const {
  const VertexSplit& split = splits_[i];
  return {split,
          child(i),
          face_count(i + 1) - split.first_face == 2,
          moved(i),
          sharpness_.empty() ? nullptr : &sharpness_[i],
          corner_sharpness_.empty() ? nullptr : &corner_sharpness_[i]};
}

/// A copy that a level does not have yet is replaced by the ancestor from which it will be split.
Array<BowTieCopy> ProgressiveMesh::bow_tie_copies(std::uint32_t level) const {
  return renamed(full_bow_tie_copies_, [&](Vertex v) {
    while (v.index() >= base_vertices_ + level)
      v = splits_[v.index() - base_vertices_].parent;
    return v;
  });
}

void ProgressiveMesh::go_to(std::uint32_t level) {
  MESHER_ASSERT(level <= split_count());
  if (level == level_) return;
  const std::uint32_t from = level_;
  Array<BowTieCopy> copies = bow_tie_copies(level);
  OpenedArrays opened(mesh_);
  if (level > from) opened.grow(base_vertices_ + level, face_count(level));
  const StepArrays arrays = opened.step_arrays();
  const auto go = [&](const auto& note) {
    for (std::uint32_t i = from; i < level; ++i)
      refine(arrays, step(i), note);
    for (std::uint32_t i = from; i > level; --i)
      coarsen(arrays, step(i - 1), note);
  };
  if ((level > from ? level - from : from - level) < kLongWay) {
    go(Notes(mesh_.changes()));
  } else {
    mesh_.changes().note_all();
    go(NoNotes());
  }
  if (level < from) opened.resize(base_vertices_ + level, face_count(level));
  MeshArrays::open(mesh_).bow_tie_copies = std::move(copies);
  level_ = level;
}

void ProgressiveMesh::undo_all(const std::function<void(std::uint32_t)>& visit) {
  MESHER_ASSERT(level_ == split_count());
  const auto end_at_level = [&](OpenedArrays& opened) {
    opened.resize(base_vertices_ + level_, face_count(level_));
    MeshArrays::open(mesh_).bow_tie_copies = bow_tie_copies(level_);
    mesh_.changes().note_all();
  };
  OpenedArrays opened(mesh_);
  const StepArrays arrays = opened.step_arrays();
  try {
    for (; level_ > 0; --level_) {
      visit(level_ - 1);
      coarsen(arrays, step(level_ - 1), NoNotes());
    }
  } catch (...) {
    end_at_level(opened);
    throw;
  }
  end_at_level(opened);
}

bool ProgressiveMesh::can_append(Vertex parent, const SplitCut& cut) const {
  constexpr std::uint32_t kMostFaces = kNone / 3 - 2;
  const std::uint32_t vertices = base_vertices_ + level_;
  if (parent.index() >= vertices || mesh_.is_isolated(parent)) return false;
  if (full_faces_ > kMostFaces || vertices >= kNone - 1) return false;
  const std::uint32_t slots = mesh_.valence(parent);
  if (cut.left >= slots) return false;
  if (cut.right == kNone) return mesh_.is_boundary(parent);
  return cut.right < slots && cut.left != cut.right;
}

void ProgressiveMesh::reserve(std::uint32_t splits) {
  constexpr std::size_t usually_moved = 4;
  splits_.reserve(splits);
  moved_.reserve(usually_moved * splits);
  const MeshArrays::InPlace arrays = MeshArrays::open(mesh_);
  arrays.position.reserve(base_vertices_ + std::size_t{splits});
  arrays.outgoing.reserve(base_vertices_ + std::size_t{splits});
  const std::size_t corners = 3 * (base_faces_ + 2 * std::size_t{splits});
  arrays.origin.reserve(corners);
  arrays.twin.reserve(corners);
  arrays.sharpness.reserve(corners);
}

void ProgressiveMesh::append(const NewSplit& split) {
  const ParentFan fan = gather_fan(mesh_, split.parent, spokes_);
  SplitAppender(*this, 1).append(split, fan);
}

NewSplit ProgressiveMesh::next_split() const {
  const VertexSplit& s = splits_[level_];
  Array<Halfedge> memory;
  const ParentFan fan = gather_fan(mesh_, s.parent, memory);
  NewSplit split{.parent = s.parent,
                 .cut = {.left = fan.slot_of(s.beyond[1])},
                 .parent_position = s.fine_position,
                 .child_position = s.child_position};
  if (face_count(level_ + 1) - s.first_face == 2) split.cut.right = fan.slot_of(s.beyond[3]);
  if (!sharpness_.empty()) split.sharpness = sharpness_[level_];
  if (!corner_sharpness_.empty()) {
    split.parent_corner_sharpness = corner_sharpness_[level_].fine_parent;
    split.child_corner_sharpness = corner_sharpness_[level_].child;
  }
  return split;
}

std::size_t ProgressiveMesh::memory_bytes() const {
  const auto bytes = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return mesh_.memory_bytes() + bytes(splits_) + bytes(moved_) + bytes(sharpness_) +
         bytes(corner_sharpness_) + bytes(full_bow_tie_copies_);
}

void go_to_level(ProgressiveMesh& mesh, std::uint32_t level, Progress* progress) {
  if (progress == nullptr) return mesh.go_to(level);
  constexpr std::uint32_t kStep = 1U << 18;
  const std::uint32_t from = mesh.level();
  const std::uint32_t way = level > from ? level - from : from - level;
  ordered_chunks(way, kStep, progress, [&](IndexRange done) {
    const auto steps = static_cast<std::uint32_t>(done.end);
    mesh.go_to(level > from ? from + steps : from - steps);
  });
}

}  // namespace mesher::progressive
