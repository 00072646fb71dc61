#include "engine/progressive/progressive_mesh.h"

#include <algorithm>
#include <utility>

#include "engine/mesh/outgoing.h"
#include "engine/progressive/split_step.h"

namespace mesher {
namespace {

// A longer way is noted as a change of everything: past about as many ranges one plain copy is
// cheaper than many.
constexpr std::uint32_t kLongWay = 4096;

/// Walks around a vertex. The memory is used again.
ParentFan gather_fan(const Mesh& mesh, Vertex v, Array<Halfedge>& memory) {
  memory.clear();
  const Halfedge start = mesh.outgoing(v);
  Halfedge h = start;
  do {
    memory.push_back(h);
    h = mesh.rotate_ccw(h);
  } while (h.is_valid() && h != start);
  return {memory, h.is_valid()};
}

/// The same with the two halves of the edge in each slot (see SplitCut); either may be none.
struct Spokes : ParentFan {
  explicit Spokes(const ParentFan& fan) : ParentFan(fan) {}

  std::uint32_t size() const { return static_cast<std::uint32_t>(out.size()); }
  Halfedge out_of(std::uint32_t slot) const { return slot < size() ? out[slot] : Halfedge{}; }
  Halfedge into(std::uint32_t slot) const {
    if (slot == 0) return is_closed ? Mesh::prev(out.back()) : Halfedge{};
    return Mesh::prev(out[slot - 1]);
  }
  std::uint32_t slot_of(Halfedge h) const {
    return static_cast<std::uint32_t>(std::find(out.begin(), out.end(), h) - out.begin());
  }
};

/// How many faces are at a vertex, and whether they close around it.
struct FanSize {
  std::uint32_t faces = 0;
  bool is_closed = false;

  FanSize(const Mesh& mesh, Vertex v) {
    const Halfedge start = mesh.outgoing(v);
    Halfedge h = start;
    do {
      ++faces;
      h = mesh.rotate_ccw(h);
    } while (h.is_valid() && h != start);
    is_closed = h.is_valid();
  }
};

/// The mesh's arrays, all resized together.
class Opened {
 public:
  explicit Opened(Mesh& mesh) : arrays_(MeshArrays::open(mesh)) {}

  /// Throws std::bad_alloc; sizes may differ then, but nothing is lost (`shrink` to what was).
  void resize(std::size_t vertices, std::size_t faces) {
    arrays_.position.resize(vertices);
    arrays_.outgoing.resize(vertices);
    if (!arrays_.vertex_sharpness.empty()) arrays_.vertex_sharpness.resize(vertices);
    arrays_.origin.resize(3 * faces);
    arrays_.twin.resize(3 * faces);
    arrays_.sharpness.resize(3 * faces);
  }
  void grow(std::size_t vertices, std::size_t faces) {
    const std::size_t vertices_before = arrays_.position.size();
    const std::size_t faces_before = arrays_.origin.size() / 3;
    try {
      resize(vertices, faces);
    } catch (...) {
      resize(vertices_before, faces_before);
      throw;
    }
  }

  StepArrays step_arrays() {
    return {arrays_.position.data(),
            arrays_.origin.data(),
            arrays_.twin.data(),
            arrays_.outgoing.data(),
            arrays_.sharpness.data(),
            arrays_.vertex_sharpness.empty() ? nullptr : arrays_.vertex_sharpness.data()};
  }

 private:
  MeshArrays::InPlace arrays_;
};

Halfedge lowest(std::span<const Halfedge> of) {
  return *std::min_element(of.begin(), of.end());
}

/// What a cut makes of the faces at the parent: those in slots [begin, end) are `inner`'s, all
/// others the other's.
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

/// Appends the corners that become the child's, in the order of P4.
void add_moved(const Spokes& spokes, const Parts& parts, Array<Halfedge>& moved) {
  const auto at = [&](std::uint32_t slot) { return spokes.out.begin() + slot; };
  if (parts.is_inner_child) {
    moved.insert(moved.end(), at(parts.begin), at(parts.end));
    return;
  }
  moved.insert(moved.end(), at(parts.end), spokes.out.end());
  moved.insert(moved.end(), at(0), at(parts.begin));
  if (!spokes.is_closed) std::reverse(moved.end() - parts.begin, moved.end());
}

/// Fills in fine_outgoing and child_outgoing.
void find_outgoing(const Spokes& spokes, const Parts& parts, bool is_pair, VertexSplit& split) {
  const std::uint32_t e = 3 * split.first_face;
  // Of an open fan the outer part has the boundary: its first side is a new one where that is cut.
  const auto start = [&](std::uint32_t opened) {
    return parts.begin == 0 ? Halfedge(opened) : spokes.out.front();
  };
  if (!is_pair) {
    split.child_outgoing = Halfedge(e);
    split.fine_outgoing = start(e + 1);
    return;
  }
  const auto all = spokes.out;
  Halfedge outer;
  if (!spokes.is_closed) {
    outer = start(parts.is_inner_child ? e + 1 : e + 4);
  } else {
    // The lowest of all is the first.
    outer = parts.begin == 0 ? lowest(all.subspan(parts.end)) : spokes.out.front();
  }
  const Halfedge inner = lowest(all.subspan(parts.begin, parts.end - parts.begin));
  split.child_outgoing = parts.is_inner_child ? inner : outer;
  split.fine_outgoing = parts.is_inner_child ? outer : inner;
}

bool is_sharp(const SplitSharpness& s) {
  return !(s == SplitSharpness{});
}

}  // namespace

ProgressiveMesh::ProgressiveMesh(Mesh&& base)
    : base_vertices_(base.vertex_count()),
      base_faces_(base.face_count()),
      full_faces_(base.face_count()) {
  MeshArrays arrays = MeshArrays::take(std::move(base));
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

void ProgressiveMesh::go_to(std::uint32_t level) {
  MESHER_ASSERT(level <= split_count());
  if (level == level_) return;
  const std::uint32_t from = level_;
  Opened opened(mesh_);
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
  level_ = level;
}

bool ProgressiveMesh::can_append(Vertex parent, const SplitCut& cut) const {
  constexpr std::uint32_t kMostFaces = kNone / 3 - 2;
  if (parent.index() >= mesh_.vertex_count() || mesh_.is_isolated(parent)) return false;
  if (full_faces_ > kMostFaces || mesh_.vertex_count() >= kNone - 1) return false;
  const FanSize fan(mesh_, parent);
  const std::uint32_t slots = fan.is_closed ? fan.faces : fan.faces + 1;
  if (cut.left >= slots) return false;
  if (cut.right == kNone) return !fan.is_closed;
  return cut.right < slots && cut.left != cut.right;
}

void ProgressiveMesh::reserve(std::uint32_t splits) {
  if (splits <= splits_.capacity()) return;
  // At least twice as much, as when they grow by themselves.
  const std::size_t count = std::max<std::size_t>(splits, 2 * splits_.capacity());
  constexpr std::size_t usually_moved = 4;
  splits_.reserve(count);
  moved_.reserve(usually_moved * count);
  const MeshArrays::InPlace arrays = MeshArrays::open(mesh_);
  arrays.position.reserve(base_vertices_ + count);
  arrays.outgoing.reserve(base_vertices_ + count);
  const std::size_t corners = 3 * (base_faces_ + 2 * count);
  arrays.origin.reserve(corners);
  arrays.twin.reserve(corners);
  arrays.sharpness.reserve(corners);
}

void ProgressiveMesh::append(const NewSplit& split) {
  append(split, gather_fan(mesh_, split.parent, spokes_));
}

void ProgressiveMesh::append(const NewSplit& split, const ParentFan& fan) {
  MESHER_ASSERT(level_ == split_count());
  const Spokes spokes(fan);
  const auto& [left, right] = split.cut;
  const bool is_pair = right != kNone;
  VertexSplit record{.parent = split.parent,
                     .first_face = full_faces_,
                     .first_moved = static_cast<std::uint32_t>(moved_.size()),
                     .coarse_outgoing = mesh_.outgoing(split.parent),
                     .beyond = {spokes.into(left), spokes.out_of(left)},
                     .coarse_position = mesh_.position(split.parent),
                     .fine_position = split.parent_position,
                     .child_position = split.child_position};
  if (is_pair) {
    record.beyond[2] = spokes.into(right);
    record.beyond[3] = spokes.out_of(right);
  }
  const Parts parts(split.cut, spokes.size());
  find_outgoing(spokes, parts, is_pair, record);
  const float coarse_corner = mesh_.sharpness(split.parent);
  try {
    add_moved(spokes, parts, moved_);
    add_sharpness(split, coarse_corner);
    splits_.push_back(record);
  } catch (...) {
    moved_.resize(record.first_moved);
    if (!sharpness_.empty()) sharpness_.resize(split_count());
    if (!corner_sharpness_.empty()) corner_sharpness_.resize(split_count());
    throw;
  }
  full_faces_ += is_pair ? 2 : 1;
  go_to(split_count());
}

void ProgressiveMesh::add_sharpness(const NewSplit& split, float coarse_corner) {
  if (has_sharp_base_ || !sharpness_.empty() || is_sharp(split.sharpness)) {
    sharpness_.resize(split_count(), SplitSharpness{});
    sharpness_.push_back(split.sharpness);
  }
  if (!mesh_.vertex_sharpnesses().empty()) {
    corner_sharpness_.push_back(
        {coarse_corner, split.parent_corner_sharpness, split.child_corner_sharpness});
  }
}

NewSplit ProgressiveMesh::next_split() const {
  const VertexSplit& s = splits_[level_];
  Array<Halfedge> memory;
  const Spokes spokes(gather_fan(mesh_, s.parent, memory));
  NewSplit split{.parent = s.parent,
                 .cut = {.left = spokes.slot_of(s.beyond[1])},
                 .parent_position = s.fine_position,
                 .child_position = s.child_position};
  if (face_count(level_ + 1) - s.first_face == 2) split.cut.right = spokes.slot_of(s.beyond[3]);
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
         bytes(corner_sharpness_);
}

}  // namespace mesher
