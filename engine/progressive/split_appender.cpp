#include "engine/progressive/split_appender.h"

#include <algorithm>
#include <span>

#include "engine/progressive/parent_fan.h"

namespace mesher::progressive {
namespace {

Halfedge lowest(std::span<const Halfedge> of) {
  return *std::min_element(of.begin(), of.end());
}

/// How a cut divides the faces at the parent: the inner part has the slots [begin, end), the outer
/// part all others. One part becomes the child's.
struct Parts {
  std::uint32_t begin;
  std::uint32_t end;
  bool is_inner_child;

  Parts(const SplitCut& cut, std::uint32_t faces) {
    const bool is_pair = cut.right != kNone;
    begin = is_pair ? std::min(cut.left, cut.right) : cut.left;
    end = is_pair ? std::max(cut.left, cut.right) : faces;
    is_inner_child = !is_pair || cut.left < cut.right;
  }
};

/// Appends the corners that move to the child, in the order of P4.
void add_moved(const ParentFan& fan, const Parts& parts, Array<Halfedge>& moved) {
  const auto at = [&](std::uint32_t slot) { return fan.out.begin() + slot; };
  if (parts.is_inner_child) {
    moved.insert(moved.end(), at(parts.begin), at(parts.end));
    return;
  }
  moved.insert(moved.end(), at(parts.end), fan.out.end());
  moved.insert(moved.end(), at(0), at(parts.begin));
  if (!fan.is_closed) std::reverse(moved.end() - parts.begin, moved.end());
}

/// Fills in fine_outgoing and child_outgoing.
void find_outgoing(const ParentFan& fan, const Parts& parts, bool is_pair, VertexSplit& split) {
  const std::uint32_t e = 3 * split.first_face;
  // The outer part of an open fan has the boundary. If the cut is there, its first side is a new
  // one.
  const auto start = [&](std::uint32_t opened) {
    return parts.begin == 0 ? Halfedge(opened) : fan.out.front();
  };
  if (!is_pair) {
    split.child_outgoing = Halfedge(e);
    split.fine_outgoing = start(e + 1);
    return;
  }
  const auto all = fan.out;
  Halfedge outer;
  if (!fan.is_closed) {
    outer = start(parts.is_inner_child ? e + 1 : e + 4);
  } else {
    // The first spoke is the lowest of all (P3).
    outer = parts.begin == 0 ? lowest(all.subspan(parts.end)) : fan.out.front();
  }
  const Halfedge inner = lowest(all.subspan(parts.begin, parts.end - parts.begin));
  split.child_outgoing = parts.is_inner_child ? inner : outer;
  split.fine_outgoing = parts.is_inner_child ? outer : inner;
}

bool is_whole(const ChangeLog& log) {
  return log.is_whole(GpuArray::position) && log.is_whole(GpuArray::origin) &&
         log.is_whole(GpuArray::edge_class);
}

}  // namespace

SplitAppender::SplitAppender(ProgressiveMesh& mesh, std::uint32_t splits)
    : mesh_(mesh), arrays_(mesh.mesh_), takes_notes_(!is_whole(mesh.mesh_.changes())) {
  MESHER_ASSERT(mesh.level() == mesh.split_count());
  arrays_.grow(mesh.base_vertices_ + mesh.level_ + splits,
               mesh.full_faces_ + 2 * std::size_t{splits});
  at_ = arrays_.step_arrays();
  mesh_.full_bow_tie_copies_.clear();
  MeshArrays::open(mesh_.mesh_).bow_tie_copies.clear();
}

SplitAppender::~SplitAppender() {
  arrays_.resize(mesh_.base_vertices_ + mesh_.level_, mesh_.full_faces_);
}

void SplitAppender::append(const NewSplit& split, const ParentFan& fan) {
  const bool is_pair = split.cut.right != kNone;
  const std::size_t moved = mesh_.moved_.size();
  try {
    reserve_moved(fan.size());
    write_record(split, fan, mesh_.splits_.emplace_back());
    add_moved(fan, Parts(split.cut, fan.size()), mesh_.moved_);
    add_sharpness(split);
  } catch (...) {
    mesh_.splits_.resize(mesh_.level_);
    mesh_.moved_.resize(moved);
    if (!mesh_.sharpness_.empty()) mesh_.sharpness_.resize(mesh_.level_);
    if (!mesh_.corner_sharpness_.empty()) mesh_.corner_sharpness_.resize(mesh_.level_);
    throw;
  }
  mesh_.full_faces_ += is_pair ? 2 : 1;
  const SplitStep step = mesh_.step(mesh_.level_++);
  if (takes_notes_) {
    refine(at_, step, Notes(mesh_.mesh_.changes()));
  } else {
    refine(at_, step, NoNotes());
  }
}

void SplitAppender::remove_last() {
  const SplitStep step = mesh_.step(--mesh_.level_);
  if (takes_notes_) {
    coarsen(at_, step, Notes(mesh_.mesh_.changes()));
  } else {
    coarsen(at_, step, NoNotes());
  }
  mesh_.full_faces_ = step.split.first_face;
  mesh_.moved_.resize(step.split.first_moved);
  mesh_.splits_.pop_back();
  if (!mesh_.sharpness_.empty()) mesh_.sharpness_.resize(mesh_.level_);
  if (!mesh_.corner_sharpness_.empty()) mesh_.corner_sharpness_.resize(mesh_.level_);
}

// Writes the record in place. Assembling it elsewhere with small stores and copying it with large
// loads would stall on store forwarding.
void SplitAppender::write_record(const NewSplit& split, const ParentFan& fan,
                                 VertexSplit& record) const {
  const auto& [left, right] = split.cut;
  const std::uint32_t parent = split.parent.index();
  record.parent = split.parent;
  record.first_face = mesh_.full_faces_;
  record.first_moved = static_cast<std::uint32_t>(mesh_.moved_.size());
  record.coarse_outgoing = at_.outgoing[parent];
  record.beyond[0] = fan.into(left);
  record.beyond[1] = fan.out_of(left);
  record.beyond[2] = right != kNone ? fan.into(right) : Halfedge{};
  record.beyond[3] = right != kNone ? fan.out_of(right) : Halfedge{};
  record.coarse_position = at_.position[parent];
  record.fine_position = split.parent_position;
  record.child_position = split.child_position;
  find_outgoing(fan, Parts(split.cut, fan.size()), right != kNone, record);
}

/// Memory is reserved for 4 moved corners per split, and files may have 16. In between, there is no
/// step, so that no third array of them is needed.
void SplitAppender::reserve_moved(std::uint32_t count) {
  constexpr std::size_t growth = 4;
  Array<Halfedge>& all = mesh_.moved_;
  const std::size_t needed = all.size() + count;
  if (needed > all.capacity()) all.reserve(std::max(needed, growth * all.capacity()));
}

void SplitAppender::add_sharpness(const NewSplit& split) {
  auto& all = mesh_.sharpness_;
  if (mesh_.has_sharp_base_ || !all.empty() || !(split.sharpness == SplitSharpness{})) {
    if (all.empty()) all.reserve(mesh_.splits_.capacity());
    all.resize(mesh_.level_, SplitSharpness{});
    all.push_back(split.sharpness);
  }
  if (at_.corner_sharpness != nullptr) {
    if (mesh_.corner_sharpness_.empty()) mesh_.corner_sharpness_.reserve(mesh_.splits_.capacity());
    mesh_.corner_sharpness_.push_back({at_.corner_sharpness[split.parent.index()],
                                       split.parent_corner_sharpness,
                                       split.child_corner_sharpness});
  }
}

}  // namespace mesher::progressive
