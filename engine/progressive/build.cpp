#include "engine/progressive/build.h"

#include <algorithm>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/outgoing.h"
#include "engine/progressive/split_step.h"
#include "engine/simplify/simplify.h"

namespace mesher {
namespace {

constexpr std::size_t kGrain = 1U << 13;
constexpr std::uint32_t kStepsBetweenReports = 1U << 16;

/// Collapses by rank, the highest first: the order of the splits.
Array<std::uint32_t> order_of_splits(std::span<const CollapseRecord> collapses) {
  Array<std::uint32_t> start(std::size_t{CollapseRecord::kRanks} + 1);
  std::fill(start.begin(), start.end(), 0U);
  for (const CollapseRecord& c : collapses)
    ++start[c.rank + 1];
  for (std::size_t rank = 1; rank < start.size(); ++rank)
    start[rank] += start[rank - 1];
  const auto last = static_cast<std::uint32_t>(collapses.size()) - 1;
  Array<std::uint32_t> order(collapses.size());
  for (std::uint32_t i = 0; i < collapses.size(); ++i)
    order[last - start[collapses[i].rank]++] = i;
  return order;
}

/// The corner of a face of the input that is its first in the progressive mesh, and that face.
struct FacePlace {
  std::uint32_t first = kNone;  ///< half-edge of the progressive mesh
  std::uint32_t turned_by = 0;
};

}  // namespace

/// The stages of build_progressive, in order, over the data they share.
class ProgressiveBuilder {
 public:
  ProgressiveBuilder(const Mesh& full, std::span<const CollapseRecord> collapses,
                     Progress* progress)
      : full_(full), collapses_(collapses), progress_(progress) {}

  Progressive run() {
    begin_stage(progress_, "recording");
    if (!collapses_.empty()) order_ = order_of_splits(collapses_);
    number_vertices();
    number_faces();
    fill_arrays();
    find_sharpness();
    go_down();
    result_.mesh.mesh_ = std::move(arrays_).finish();
    return std::move(result_);
  }

 private:
  std::uint32_t split_count() const { return static_cast<std::uint32_t>(collapses_.size()); }

  /// Survivors first, in the input's order, then the removed ones as splits bring them back.
  void number_vertices() {
    const std::uint32_t vertices = full_.vertex_count();
    const std::uint32_t base = vertices - split_count();
    result_.mesh.base_vertices_ = base;
    place_.resize(vertices);
    result_.vertex_source.resize(vertices);
    std::fill(place_.begin(), place_.end(), Vertex{});
    for (std::uint32_t i = 0; i < split_count(); ++i) {
      const Vertex removed = collapses_[order_[i]].removed;
      place_[removed.index()] = Vertex(base + i);
      result_.vertex_source[base + i] = removed;
    }
    std::uint32_t next = 0;
    for (std::uint32_t v = 0; v < vertices; ++v) {
      if (place_[v].is_valid()) continue;
      place_[v] = Vertex(next);
      result_.vertex_source[next++] = Vertex(v);
    }
  }

  void number_faces() {
    const std::uint32_t faces = full_.face_count();
    std::uint32_t removed = 0;
    for (const CollapseRecord& c : collapses_)
      removed += c.twin.is_valid() ? 2 : 1;
    result_.mesh.base_faces_ = faces - removed;
    result_.mesh.full_faces_ = faces;
    result_.mesh.level_ = split_count();
    face_place_.assign(faces, FacePlace{});
    result_.face_source.resize(faces);
    result_.mesh.splits_.resize(split_count());
    std::uint32_t next = faces - removed;
    const auto place = [&](Halfedge first, std::uint32_t f) {
      face_place_[Mesh::face(first).index()] = {3 * f, Mesh::corner(first)};
      result_.face_source[f] = first;
    };
    for (std::uint32_t i = 0; i < split_count(); ++i) {
      const CollapseRecord& c = collapses_[order_[i]];
      result_.mesh.splits_[i].first_face = next;
      place(c.halfedge, next++);
      if (c.twin.is_valid()) place(c.twin, next++);
    }
    next = 0;
    for (std::uint32_t f = 0; f < faces; ++f) {
      if (face_place_[f].first == kNone) place(Halfedge(3 * f), next++);
    }
  }

  Halfedge placed(Halfedge h) const {
    if (!h.is_valid()) return h;
    const FacePlace& place = face_place_[Mesh::face(h).index()];
    const std::uint32_t corner = Mesh::corner(h) + 3 - place.turned_by;
    return Halfedge(place.first + (corner >= 3 ? corner - 3 : corner));
  }

  void fill_arrays() {
    const std::uint32_t vertices = full_.vertex_count();
    const std::uint32_t faces = full_.face_count();
    arrays_.position.resize(vertices);
    const bool has_own = !full_.vertex_sharpnesses().empty();
    if (has_own) arrays_.vertex_sharpness.resize(vertices);
    parallel_for_each(vertices, kGrain, [&](std::uint32_t v) {
      arrays_.position[v] = full_.position(result_.vertex_source[v]);
      if (has_own) arrays_.vertex_sharpness[v] = full_.sharpness(result_.vertex_source[v]);
    });
    arrays_.origin.resize(3 * std::size_t{faces});
    arrays_.twin.resize(3 * std::size_t{faces});
    arrays_.sharpness.resize(3 * std::size_t{faces});
    parallel_for_each(faces, kGrain, [&](std::uint32_t f) {
      Halfedge from = result_.face_source[f];
      for (std::uint32_t to = 3 * f; to < 3 * f + 3; ++to) {
        arrays_.origin[to] = place_[full_.origin(from).index()];
        arrays_.twin[to] = placed(full_.twin(from));
        arrays_.sharpness[to] = full_.sharpness(from);
        from = Mesh::next(from);
      }
    });
    fill_outgoing(arrays_);
  }

  void find_sharpness() {
    const bool is_sharp = std::any_of(arrays_.sharpness.begin(), arrays_.sharpness.end(),
                                      [](float sharpness) { return sharpness > 0.0F; });
    if (is_sharp) result_.mesh.sharpness_.resize(split_count());
    if (!arrays_.vertex_sharpness.empty()) result_.mesh.corner_sharpness_.resize(split_count());
  }

  /// Collapses the last split first, and notes what it takes to undo that.
  void go_down() {
    auto& moved = result_.mesh.moved_;
    moved.reserve(4 * std::size_t{split_count()});
    const StepArrays arrays{
        arrays_.position.data(),
        arrays_.origin.data(),
        arrays_.twin.data(),
        arrays_.outgoing.data(),
        arrays_.sharpness.data(),
        arrays_.vertex_sharpness.empty() ? nullptr : arrays_.vertex_sharpness.data()};
    std::uint32_t end = result_.mesh.full_faces_;
    for (std::uint32_t i = split_count(); i-- > 0;) {
      VertexSplit& split = result_.mesh.splits_[i];
      const bool is_pair = std::exchange(end, split.first_face) - split.first_face == 2;
      const auto before = static_cast<std::ptrdiff_t>(moved.size());
      note_split(i, is_pair);
      const SplitStep step{split,
                           result_.mesh.child(i),
                           is_pair,
                           std::span(moved).subspan(static_cast<std::size_t>(before)),
                           note_sharpness(i, is_pair),
                           note_corner_sharpness(i)};
      coarsen(arrays, step, NoNotes{});
      std::reverse(moved.begin() + before, moved.end());
      split.first_moved = static_cast<std::uint32_t>(moved.size());
      if (i % kStepsBetweenReports == 0) {
        report(progress_, 1.0F - static_cast<float>(i) / static_cast<float>(split_count()));
      }
    }
    turn_moved_around();
    cut_to_base();
  }

  /// They were gathered from the last to the first.
  void turn_moved_around() {
    auto& moved = result_.mesh.moved_;
    std::reverse(moved.begin(), moved.end());
    for (VertexSplit& split : result_.mesh.splits_)
      split.first_moved = static_cast<std::uint32_t>(moved.size()) - split.first_moved;
  }

  void cut_to_base() {
    result_.mesh.level_ = 0;
    const std::size_t faces = result_.mesh.base_faces_;
    const std::size_t vertices = result_.mesh.base_vertices_;
    arrays_.position.resize(vertices);
    arrays_.outgoing.resize(vertices);
    if (!arrays_.vertex_sharpness.empty()) arrays_.vertex_sharpness.resize(vertices);
    arrays_.origin.resize(3 * faces);
    arrays_.twin.resize(3 * faces);
    arrays_.sharpness.resize(3 * faces);
  }

  Halfedge twin(Halfedge h) const { return arrays_.twin[h.index()]; }

  /// Everything of split i that its finer level shows. Corners that it moves are appended.
  void note_split(std::uint32_t i, bool is_pair) {
    VertexSplit& split = result_.mesh.splits_[i];
    const CollapseRecord& collapse = collapses_[order_[i]];
    const Vertex child = result_.mesh.child(i);
    const std::uint32_t e = 3 * split.first_face;
    split.parent = arrays_.origin[e + 1];
    split.coarse_position = collapse.position;
    split.fine_position = arrays_.position[split.parent.index()];
    split.child_position = arrays_.position[child.index()];
    split.fine_outgoing = arrays_.outgoing[split.parent.index()];
    split.child_outgoing = arrays_.outgoing[child.index()];
    split.beyond = {arrays_.twin[e + 1], arrays_.twin[e + 2], Halfedge{}, Halfedge{}};
    if (is_pair) {
      split.beyond[2] = arrays_.twin[e + 4];
      split.beyond[3] = arrays_.twin[e + 5];
    }
    gather_moved(split, is_pair);
    split.coarse_outgoing = merged_outgoing(split, is_pair);
  }

  void gather_moved(const VertexSplit& split, bool is_pair) {
    auto& moved = result_.mesh.moved_;
    const Halfedge end(is_pair ? 3 * split.first_face + 4 : kNone);
    Halfedge h = split.beyond[1];
    for (; h.is_valid() && h != end; h = twin(Mesh::prev(h)))
      moved.push_back(h);
    if (h == end) return;
    for (Halfedge t = split.beyond[2]; t.is_valid(); t = twin(h)) {
      h = Mesh::next(t);
      moved.push_back(h);
    }
  }

  /// outgoing(parent) before the split (P3, and the start of the fan at a boundary).
  Halfedge merged_outgoing(const VertexSplit& split, bool is_pair) const {
    const std::uint32_t e = 3 * split.first_face;
    const bool is_parent_open = !twin(split.fine_outgoing).is_valid();
    const bool is_child_open = !twin(split.child_outgoing).is_valid();
    if (!is_parent_open && !is_child_open) {
      return std::min(split.fine_outgoing, split.child_outgoing);
    }
    // Where the fan starts with a side that vanishes, it starts with what lies beyond.
    const Halfedge start = is_parent_open ? split.fine_outgoing : split.child_outgoing;
    if (start == Halfedge(e + 1)) return split.beyond[1];
    if (is_pair && start == Halfedge(e + 4)) return split.beyond[3];
    return start;
  }

  const SplitSharpness* note_sharpness(std::uint32_t i, bool is_pair) {
    auto& all = result_.mesh.sharpness_;
    if (all.empty()) return nullptr;
    const float* sides = &arrays_.sharpness[3 * std::size_t{result_.mesh.splits_[i].first_face}];
    all[i] = {sides[0], {sides[1], sides[2], 0.0F, 0.0F}};
    if (is_pair) all[i].sides = {sides[1], sides[2], sides[4], sides[5]};
    return &all[i];
  }

  const SplitCornerSharpness* note_corner_sharpness(std::uint32_t i) {
    auto& all = result_.mesh.corner_sharpness_;
    if (all.empty()) return nullptr;
    const float parent = arrays_.vertex_sharpness[result_.mesh.splits_[i].parent.index()];
    const float child = arrays_.vertex_sharpness[result_.mesh.child(i).index()];
    all[i] = {std::max(parent, child), parent, child};
    return &all[i];
  }

  const Mesh& full_;
  std::span<const CollapseRecord> collapses_;
  Progress* progress_;
  Array<std::uint32_t> order_;
  Array<Vertex> place_;  ///< of the input's vertices
  Array<FacePlace> face_place_;
  MeshArrays arrays_;
  Progressive result_;
};

Progressive build_progressive(const Mesh& full, std::span<const CollapseRecord> collapses,
                              Progress* progress) {
  return ProgressiveBuilder(full, collapses, progress).run();
}

Progressive make_progressive(const Mesh& full, const SimplifyOptions& options) {
  CollapseRecorder recorder;
  SimplifyOptions recorded = options;
  recorded.observer = &recorder;
  const SimplifyReport report = simplify(Mesh(full), recorded).report;
  Progressive result = build_progressive(full, recorder.records(), options.progress);
  result.report = report;
  return result;
}

}  // namespace mesher
