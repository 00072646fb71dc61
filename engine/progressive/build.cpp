#include "engine/progressive/build.h"

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/mesh/bow_tie_follower.h"
#include "engine/mesh/circulators.h"
#include "engine/progressive/attribute_recorder.h"
#include "engine/progressive/split_step.h"
#include "engine/simplify/seams.h"
#include "engine/simplify/simplify.h"

namespace mesher::progressive {
namespace {

constexpr std::size_t kGrain = 1U << 13;
constexpr std::uint32_t kStepsBetweenReports = 1U << 14;
// Weights of stages, measured with 0.1, 1.4 and 13 million faces on two cores.
/// Times of simplifying and of recording the splits.
constexpr double kMakeWeights[] = {0.89, 0.11};
/// Times of making the splits, and of recording attributes.
constexpr double kAttributeWeights[] = {0.7, 0.3};
/// Times of recording's stages: renumbering, and undoing the splits one by one.
constexpr double kRecordWeights[] = {0.55, 0.45};
/// Times of numbering, renumbering, filling the arrays, and sharpness.
constexpr double kNumberWeights[] = {0.18, 0.18, 0.61, 0.03};

/// Sorts by rank, highest first, and reverses equal ranks: the order of the splits.
Array<simplify::CollapseRecord> sorted_by_rank(
    std::span<const simplify::CollapseRecord> collapses) {
  Array<std::uint32_t> start(std::size_t{simplify::CollapseRecord::kRanks} + 1);
  std::fill(start.begin(), start.end(), 0U);
  for (const simplify::CollapseRecord& c : collapses)
    ++start[c.rank + 1];
  for (std::size_t rank = 1; rank < start.size(); ++rank)
    start[rank] += start[rank - 1];
  Array<simplify::CollapseRecord> sorted(collapses.size());
  for (const simplify::CollapseRecord& c : collapses)
    sorted[collapses.size() - 1 - start[c.rank]++] = c;
  return sorted;
}

/// Calls work(i, range) for pieces of [0, counts[i]), in any order, several at once.
template <class Work>
void in_pieces(std::initializer_list<std::size_t> counts, const Work& work) {
  struct Piece {
    std::size_t work;
    IndexRange range;
  };
  std::vector<Piece> pieces;
  std::size_t i = counts.size();
  // The last work comes first, because it cannot be split.
  for (const std::size_t* count = counts.end(); count != counts.begin();) {
    --count;
    --i;
    for (std::size_t begin = 0; begin < *count; begin += kGrain)
      pieces.push_back({i, {begin, std::min(begin + kGrain, *count)}});
  }
  parallel_for(pieces.size(), 1, [&](IndexRange range) {
    for (std::size_t k = range.begin; k < range.end; ++k)
      work(pieces[k].work, pieces[k].range);
  });
}

/// Returns the half-edge `steps` corners after h in its face. Pre: steps < 3.
Halfedge turned(Halfedge h, std::uint32_t steps) {
  const std::uint32_t corner = Mesh::corner(h) + steps;
  return Halfedge(h.index() + steps - (corner >= 3 ? 3 : 0));
}

}  // namespace

/// The stages of build_progressive, in order, with the data they share.
class ProgressiveBuilder {
 public:
  ProgressiveBuilder(const Mesh& full, std::span<const simplify::CollapseRecord> collapses,
                     Progress* progress)
      : full_(full), collapses_(sorted_by_rank(collapses)), progress_(progress) {}

  Progressive run() {
    begin_stage(progress_, "recording");
    Stages stages(progress_, kRecordWeights);
    stages.next();
    number_all();
    stages.next();
    go_down();
    list_bow_tie_copies();
    result_.mesh.mesh_ = std::move(arrays_).finish();
    return std::move(result_);
  }

 private:
  void number_all() {
    Stages stages(progress_, kNumberWeights);
    stages.next();
    in_pieces({1, 1}, [&](std::size_t work, IndexRange) {
      if (work == 0) number_faces();
      if (work == 1) number_vertices();
    });
    stages.next();
    renumber_parts();
    stages.next();
    fill_arrays();
    stages.next();
    fill_sharpness();
  }

  std::uint32_t split_count() const { return static_cast<std::uint32_t>(collapses_.size()); }

  /// Survivors come first, in the input's order, then the removed vertices in the order of the
  /// splits.
  void number_vertices() {
    const std::uint32_t vertices = full_.vertex_count();
    const std::uint32_t base = vertices - split_count();
    result_.mesh.base_vertices_ = base;
    new_vertex_.resize(vertices);
    result_.vertex_source.resize(vertices);
    std::fill(new_vertex_.begin(), new_vertex_.end(), Vertex{});
    for (std::uint32_t i = 0; i < split_count(); ++i) {
      const Vertex removed = collapses_[i].removed;
      new_vertex_[removed.index()] = Vertex(base + i);
      result_.vertex_source[base + i] = removed;
    }
    std::uint32_t next = 0;
    for (std::uint32_t v = 0; v < vertices; ++v) {
      if (new_vertex_[v].is_valid()) continue;
      new_vertex_[v] = Vertex(next);
      result_.vertex_source[next++] = Vertex(v);
    }
  }

  /// Finds where the faces of each chunk of splits begin, after those of the base.
  void number_faces() {
    const std::uint32_t faces = full_.face_count();
    std::uint32_t removed = 0;
    for (std::uint32_t i = 0; i < split_count(); ++i) {
      if (i % kGrain == 0) first_faces_.push_back(removed);
      removed += collapses_[i].twin.is_valid() ? 2 : 1;
    }
    for (std::uint32_t& first : first_faces_)
      first += faces - removed;
    result_.mesh.base_faces_ = faces - removed;
    result_.mesh.full_faces_ = faces;
    result_.mesh.level_ = split_count();
    result_.mesh.splits_.resize(split_count());
  }

  /// Renumbers the vertices and faces that splits add, in parallel, then the faces of the base.
  void renumber_parts() {
    const std::uint32_t vertices = full_.vertex_count();
    const std::uint32_t faces = full_.face_count();
    arrays_.position.resize(vertices);
    if (!full_.vertex_sharpnesses().empty()) arrays_.vertex_sharpness.resize(vertices);
    new_first_corner_.assign(faces, Halfedge{});
    result_.face_source.resize(faces);
    in_pieces({split_count(), vertices}, [&](std::size_t work, IndexRange range) {
      if (work == 0) renumber_split_faces(range);
      if (work == 1) fill_vertices(range);
    });
    std::uint32_t next = 0;
    for (std::uint32_t f = 0; f < faces; ++f) {
      if (!new_first_corner_[f].is_valid()) renumber_face(Halfedge(3 * f), next++);
    }
  }

  void renumber_split_faces(IndexRange splits) {
    std::uint32_t next = first_faces_[splits.begin / kGrain];
    for (std::size_t i = splits.begin; i < splits.end; ++i) {
      const simplify::CollapseRecord& c = collapses_[i];
      result_.mesh.splits_[i].first_face = next;
      renumber_face(c.halfedge, next++);
      if (c.twin.is_valid()) renumber_face(c.twin, next++);
    }
  }

  /// The face of `first` becomes `f`, with `first` as its first half-edge.
  void renumber_face(Halfedge first, std::uint32_t f) {
    const std::uint32_t corner = Mesh::corner(first);
    new_first_corner_[Mesh::face(first).index()] =
        turned(Halfedge(3 * f), corner == 0 ? 0 : 3 - corner);
    result_.face_source[f] = first;
  }

  Halfedge renumbered(Halfedge h) const {
    return h.is_valid() ? turned(new_first_corner_[Mesh::face(h).index()], Mesh::corner(h)) : h;
  }

  void fill_vertices(IndexRange vertices) {
    const bool has_own = !arrays_.vertex_sharpness.empty();
    for (auto v = static_cast<std::uint32_t>(vertices.begin); v < vertices.end; ++v) {
      const std::uint32_t to = new_vertex_[v].index();
      arrays_.position[to] = full_.position(Vertex(v));
      if (has_own) arrays_.vertex_sharpness[to] = full_.sharpness(Vertex(v));
    }
  }

  void fill_arrays() {
    arrays_.twin.resize(full_.halfedge_count());
    in_pieces({full_.face_count(), 1, 1, 1}, [&](std::size_t work, IndexRange range) {
      if (work == 0) fill_twins(range);
      if (work == 1) note_positions();
      if (work == 2) lower_half_.find(*this, {0, full_.halfedge_count() / 2});
      if (work == 3) upper_half_.find(*this, {full_.halfedge_count() / 2, full_.halfedge_count()});
    });
    fill_outgoing();
  }

  /// In input order, whose neighbors are close in memory: the reads hit the cache, and the
  /// scattered writes stall nothing.
  void fill_twins(IndexRange faces) {
    for (auto f = static_cast<std::uint32_t>(faces.begin); f < faces.end; ++f) {
      Halfedge to = new_first_corner_[f];
      for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
        arrays_.twin[to.index()] = renumbered(full_.twin(Halfedge(h)));
        to = Mesh::next(to);
      }
    }
  }

  /// By vertex of the full mesh, numbered as in the input: the lowest half-edge out of it among a
  /// range of half-edges. Also the half-edges of the range that begin a fan at a boundary.
  struct Outgoing {
    Array<Halfedge> lowest;
    std::vector<Halfedge> starts;

    void find(const ProgressiveBuilder& b, IndexRange halfedges) {
      lowest.assign(b.full_.vertex_count(), Halfedge{});
      for (auto i = static_cast<std::uint32_t>(halfedges.begin); i < halfedges.end; ++i) {
        const Halfedge h(i);
        Halfedge& its = lowest[b.full_.origin(h).index()];
        its = std::min(its, b.renumbered(h));  // an invalid half-edge has the highest index
        if (b.full_.is_boundary(h)) starts.push_back(h);
      }
    }
  };

  /// P3 at full detail; at a boundary, the half-edge where the fan begins.
  void fill_outgoing() {
    arrays_.outgoing.resize(full_.vertex_count());
    for (std::uint32_t v = 0; v < full_.vertex_count(); ++v) {
      arrays_.outgoing[new_vertex_[v].index()] =
          std::min(lower_half_.lowest[v], upper_half_.lowest[v]);
    }
    for (const Outgoing* half : {&lower_half_, &upper_half_}) {
      for (const Halfedge h : half->starts)
        arrays_.outgoing[new_vertex_[full_.origin(h).index()].index()] = renumbered(h);
    }
  }

  /// Records the positions before and after each split; those of the base remain in the array.
  void note_positions() {
    for (std::uint32_t i = split_count(); i-- > 0;) {
      VertexSplit& split = result_.mesh.splits_[i];
      split.parent = new_vertex_[collapses_[i].kept.index()];
      glm::vec3& at_parent = arrays_.position[split.parent.index()];
      split.child_position = arrays_.position[result_.mesh.child(i).index()];
      split.fine_position = at_parent;
      split.coarse_position = at_parent = collapses_[i].position;
    }
  }

  void fill_sharpness() {
    const auto sharpness = full_.sharpnesses();
    if (std::none_of(sharpness.begin(), sharpness.end(), [](float s) { return s > 0.0F; })) {
      arrays_.sharpness.assign(3 * std::size_t{result_.mesh.base_faces_}, 0.0F);
    } else {
      arrays_.sharpness.resize(sharpness.size());
      for (std::uint32_t h = 0; h < full_.halfedge_count(); ++h)
        arrays_.sharpness[renumbered(Halfedge(h)).index()] = sharpness[h];
      result_.mesh.sharpness_.resize(split_count());
      result_.mesh.has_sharp_base_ = true;
    }
    if (!arrays_.vertex_sharpness.empty()) result_.mesh.corner_sharpness_.resize(split_count());
  }

  /// Undoes the splits from the last to the first and records what is needed to redo them. Origins
  /// are not maintained, because only the base needs them.
  void go_down() {
    auto& moved = result_.mesh.moved_;
    moved.reserve(4 * std::size_t{split_count()});
    merged_into_.resize(full_.vertex_count());
    std::fill(merged_into_.begin(), merged_into_.end(), Vertex{});
    std::uint32_t end = result_.mesh.full_faces_;
    for (std::uint32_t i = split_count(); i-- > 0;) {
      VertexSplit& split = result_.mesh.splits_[i];
      const bool is_pair = std::exchange(end, split.first_face) - split.first_face == 2;
      const auto before = static_cast<std::ptrdiff_t>(moved.size());
      note_split(i, is_pair);
      note_sharpness(i, is_pair);
      collapse(i, is_pair);
      std::reverse(moved.begin() + before, moved.end());
      split.first_moved = static_cast<std::uint32_t>(moved.size());
      if (i % kStepsBetweenReports == 0) {
        report(progress_, 1.0F - static_cast<float>(i) / static_cast<float>(split_count()));
      }
    }
    turn_moved_around();
    cut_to_base();
    fill_base_origins();
  }

  void collapse(std::uint32_t i, bool is_pair) {
    const VertexSplit& split = result_.mesh.splits_[i];
    const auto& [into_parent, out_of_child, into_child, out_of_parent] = split.beyond;
    const std::uint32_t e = 3 * split.first_face;
    Halfedge* const twins = arrays_.twin.data();
    arrays_.outgoing[split.parent.index()] = split.coarse_outgoing;
    if (!out_of_child.is_valid()) arrays_.outgoing[present_origin(e + 2).index()] = into_parent;
    close_side(twins, into_parent, out_of_child);
    if (is_pair) {
      if (!out_of_parent.is_valid()) arrays_.outgoing[present_origin(e + 5).index()] = into_child;
      close_side(twins, into_child, out_of_parent);
    }
    merged_into_[result_.mesh.child(i).index()] = split.parent;
  }

  /// Returns the vertex into which a vertex of the full mesh has been merged so far, with path
  /// halving.
  Vertex present(Vertex v) {
    while (merged_into_[v.index()].is_valid()) {
      Vertex& next = merged_into_[v.index()];
      if (merged_into_[next.index()].is_valid()) next = merged_into_[next.index()];
      v = next;
    }
    return v;
  }
  Vertex present_origin(std::uint32_t h) {
    const Halfedge source = turned(result_.face_source[h / 3], h % 3);
    return present(new_vertex_[full_.origin(source).index()]);
  }

  void fill_base_origins() {
    arrays_.origin.resize(3 * std::size_t{result_.mesh.base_faces_});
    for (std::uint32_t h = 0; h < arrays_.origin.size(); ++h)
      arrays_.origin[h] = present_origin(h);
  }

  /// The moved corners were gathered from the last split to the first.
  void turn_moved_around() {
    auto& moved = result_.mesh.moved_;
    const auto count = static_cast<std::uint32_t>(moved.size());
    const std::size_t half = count / 2;
    in_pieces({split_count(), half}, [&](std::size_t work, IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        if (work == 1) {
          std::swap(moved[i], moved[count - 1 - i]);
        } else {
          VertexSplit& split = result_.mesh.splits_[i];
          split.first_moved = count - split.first_moved;
        }
      }
    });
  }

  void cut_to_base() {
    result_.mesh.level_ = 0;
    const std::size_t faces = result_.mesh.base_faces_;
    const std::size_t vertices = result_.mesh.base_vertices_;
    arrays_.position.resize(vertices);
    arrays_.outgoing.resize(vertices);
    if (!arrays_.vertex_sharpness.empty()) arrays_.vertex_sharpness.resize(vertices);
    arrays_.twin.resize(3 * faces);
    arrays_.sharpness.resize(3 * faces);
  }

  void list_bow_tie_copies() {
    if (full_.bow_tie_copies().empty()) return;
    BowTieFollower follower(full_);
    for (std::uint32_t i = split_count(); i-- > 0;)
      follower.merge(collapses_[i].removed, collapses_[i].kept, collapses_[i].position);
    const auto renumbered = [&](Vertex v) { return new_vertex_[v.index()]; };
    result_.mesh.full_bow_tie_copies_ = renamed(follower.before(), renumbered);
    arrays_.bow_tie_copies = renamed(follower.after(), renumbered);
  }

  Halfedge twin(Halfedge h) const { return arrays_.twin[h.index()]; }

  /// Records everything about split i that its finer level shows. Appends the corners that it
  /// moves.
  void note_split(std::uint32_t i, bool is_pair) {
    VertexSplit& split = result_.mesh.splits_[i];
    const std::uint32_t e = 3 * split.first_face;
    split.fine_outgoing = arrays_.outgoing[split.parent.index()];
    split.child_outgoing = arrays_.outgoing[result_.mesh.child(i).index()];
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
    const TwinView twins{arrays_.twin};
    Halfedge h = split.beyond[1];
    for (; h.is_valid() && h != end; h = twins.rotate_ccw(h))
      moved.push_back(h);
    if (h == end) return;
    for (h = twins.rotate_cw(end); h.is_valid(); h = twins.rotate_cw(h))
      moved.push_back(h);
  }

  /// Returns outgoing(parent) before the split: by P3, or the begin of the fan at a boundary.
  Halfedge merged_outgoing(const VertexSplit& split, bool is_pair) const {
    const std::uint32_t e = 3 * split.first_face;
    const bool is_parent_open = !twin(split.fine_outgoing).is_valid();
    const bool is_child_open = !twin(split.child_outgoing).is_valid();
    if (!is_parent_open && !is_child_open) {
      return std::min(split.fine_outgoing, split.child_outgoing);
    }
    // If the fan begins with a side that vanishes, it begins with the half-edge beyond that side.
    const Halfedge start = is_parent_open ? split.fine_outgoing : split.child_outgoing;
    if (start == Halfedge(e + 1)) return split.beyond[1];
    if (is_pair && start == Halfedge(e + 4)) return split.beyond[3];
    return start;
  }

  void note_sharpness(std::uint32_t i, bool is_pair) {
    if (auto& all = result_.mesh.sharpness_; !all.empty()) {
      const VertexSplit& split = result_.mesh.splits_[i];
      const float* sides = &arrays_.sharpness[3 * std::size_t{split.first_face}];
      all[i] = {sides[0], {sides[1], sides[2], 0.0F, 0.0F}};
      if (is_pair) all[i].sides = {sides[1], sides[2], sides[4], sides[5]};
      coarsen_sharpness(arrays_.sharpness.data(), split, all[i]);
    }
    if (auto& all = result_.mesh.corner_sharpness_; !all.empty()) {
      float& parent = arrays_.vertex_sharpness[result_.mesh.splits_[i].parent.index()];
      const float child = arrays_.vertex_sharpness[result_.mesh.child(i).index()];
      all[i] = {std::max(parent, child), parent, child};
      parent = all[i].coarse_parent;
    }
  }

  const Mesh& full_;
  Array<simplify::CollapseRecord> collapses_;  ///< in the order of the splits
  Progress* progress_;
  Array<Vertex> new_vertex_;  ///< by the input's vertices
  /// By the input's faces, the new half-edge of their first corner
  Array<Halfedge> new_first_corner_;
  std::vector<std::uint32_t> first_faces_;  ///< by chunk of kGrain splits
  Array<Vertex> merged_into_;               ///< by the progressive mesh's vertices; none: alive
  Outgoing lower_half_;
  Outgoing upper_half_;
  MeshArrays arrays_;
  Progressive result_;
};

Progressive build_progressive(const Mesh& full, std::span<const simplify::CollapseRecord> collapses,
                              Progress* progress) {
  return ProgressiveBuilder(full, collapses, progress).run();
}

namespace {

/// Simplifies `start` and returns the splits to `full`, which may differ from it in sharpness.
Progressive make_splits(const Mesh& full, Mesh&& start, const simplify::SimplifyOptions& options) {
  Stages stages(options.progress, kMakeWeights);
  stages.next("simplifying");
  simplify::CollapseRecorder recorder;
  simplify::SimplifyOptions recorded = options;
  recorded.observer = &recorder;
  const simplify::SimplifyReport report = simplify::simplify(std::move(start), recorded).report;
  stages.next();
  Progressive result = build_progressive(full, recorder.records(), options.progress);
  result.report = report;
  return result;
}

}  // namespace

Progressive make_progressive(const Mesh& full, const simplify::SimplifyOptions& options) {
  return make_splits(full, Mesh(full), options);
}

Progressive make_progressive(const Mesh& full, const Attributes& attributes,
                             const simplify::SimplifyOptions& options) {
  if (attributes.is_empty()) return make_progressive(full, options);
  Stages stages(options.progress, kAttributeWeights);
  stages.next();
  Mesh marked(full);
  simplify::mark_seams(marked, attributes);
  const simplify::AttributeMetric metric =
      simplify::attribute_metric(full, attributes, options.weights());
  simplify::SimplifyOptions weighted = options;
  if (metric.size > 0) weighted.metric = &metric;
  Progressive result = make_splits(full, std::move(marked), weighted);
  stages.next("recording attributes");
  result.attributes =
      record_attributes(result.mesh, full, result.face_source, attributes, options.progress);
  return result;
}

}  // namespace mesher::progressive
