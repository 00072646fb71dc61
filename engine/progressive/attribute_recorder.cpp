#include "engine/progressive/attribute_recorder.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"
#include "engine/progressive/merged_value.h"
#include "engine/simplify/seams.h"

namespace mesher::progressive {
namespace {

constexpr std::uint32_t kUndosBetweenReports = 1U << 12;
constexpr std::size_t kCornerGrain = std::size_t{1} << 14;

/// The wedges of a vertex that no line separates are in one class: a collapse gives their corners
/// one value.
class WedgeClasses {
 public:
  WedgeClasses(const Mesh& mesh, const Attributes& attributes, std::size_t wedges)
      : class_(wedges), is_mixed_(wedges, 0) {
    std::iota(class_.begin(), class_.end(), 0U);
    const simplify::Lines lines(mesh, attributes);
    for (std::uint32_t i = 0; i < mesh.halfedge_count() && attributes.has_seams(); ++i) {
      const Halfedge h(i);
      const Halfedge t = mesh.twin(h);
      if (!t.is_valid() || lines[h]) continue;
      unite(attributes.wedge(mesh.origins(), h).index(),
            attributes.wedge(mesh.origins(), Mesh::next(t)).index());
    }
    for (std::uint32_t w = 0; w < wedges; ++w)
      class_[w] = root(w);
  }

  std::uint32_t of(Wedge w) const { return class_[w.index()]; }
  /// Returns whether the class has had several wedges from the start.
  bool is_mixed(Wedge w) const { return is_mixed_[of(w)] != 0; }
  /// Makes a class of one wedge.
  void isolate(Wedge w) {
    class_[w.index()] = w.index();
    is_mixed_[w.index()] = 0;
  }

 private:
  std::uint32_t root(std::uint32_t w) {
    while (class_[w] != w)
      w = class_[w] = class_[class_[w]];
    return w;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    if (low == high) return;
    class_[high] = low;
    is_mixed_[low] = 1;
  }

  Array<std::uint32_t> class_;
  std::vector<std::uint8_t> is_mixed_;  ///< by class
};

/// A side of the edge between parent and child, and the wedge that its corners get before the
/// split.
struct Side {
  Wedge at_child;
  Wedge at_parent;
  std::uint32_t child_class = kNone;
  std::uint32_t parent_class = kNone;
  Wedge merged;

  bool contains(std::uint32_t wedge_class) const {
    return wedge_class == child_class || wedge_class == parent_class;
  }
};

}  // namespace

/// The stages of record_attributes, with the data they share. Wedges have the input's ids until all
/// splits are undone.
class AttributeRecorder {
 public:
  AttributeRecorder(ProgressiveMesh& mesh, const Mesh& full, std::span<const Halfedge> face_source,
                    const Attributes& attributes)
      : mesh_(mesh), classes_(full, attributes, full.vertex_count() + attributes.further.size()) {
    result_.arrays_.groups = attributes.groups;
    result_.arrays_.layers = attributes.layers;
    result_.splits_.resize(mesh.split_count());
    result_.level_ = 0;
    const simplify::SeamTest seams(full, attributes);
    for (const AttributeLayer& layer : attributes.layers) {
      result_.others_.emplace_back(layer.type(), 0);
      merged_values_.emplace_back(layer.type(), 2);
      const bool may_be_faceted = layer.type().kind == AttributeKind::normal;
      result_.is_faceted_.push_back(may_be_faceted && seams.has_value_per_face(layer) ? 1 : 0);
    }
    const auto faces = static_cast<std::uint32_t>(face_source.size());
    if (!attributes.group.empty()) {
      result_.arrays_.group.resize(faces);
      for (std::uint32_t f = 0; f < faces; ++f)
        result_.arrays_.group[f] = attributes.group[Mesh::face(face_source[f]).index()];
    }
    if (attributes.layers.empty()) return;
    result_.arrays_.corner_wedge.resize(3 * std::size_t{faces});
    corners_of_wedge_.assign(full.vertex_count() + attributes.further.size(), 0);
    for (std::uint32_t f = 0; f < faces; ++f) {
      Halfedge source = face_source[f];
      for (std::uint32_t c = 0; c < 3; ++c, source = Mesh::next(source)) {
        const Wedge w = attributes.wedge(full.origins(), source);
        result_.arrays_.corner_wedge[3 * std::size_t{f} + c] = w;
        ++corners_of_wedge_[w.index()];
      }
    }
  }

  ProgressiveAttributes run(Progress* progress) {
    mesh_.go_to(mesh_.split_count());
    mesh_.undo_all([&](std::uint32_t i) {
      if (i % kUndosBetweenReports == 0) {
        report(progress, 1.0F - static_cast<float>(i) / static_cast<float>(mesh_.split_count()));
      }
      if (!result_.arrays_.layers.empty()) undo(i);
    });
    put_in_order();
    return std::move(result_);
  }

 private:
  Wedge& wedge(Halfedge h) { return result_.arrays_.corner_wedge[h.index()]; }

  /// Records split i and undoes it. Pre: the mesh is at level i + 1.
  void undo(std::uint32_t i) {
    const VertexSplit& split = mesh_.splits()[i];
    const std::uint32_t e = 3 * split.first_face;
    const bool is_pair = mesh_.face_count(i + 1) - split.first_face == 2;
    find_corners(i, is_pair);
    sides_.clear();
    add_side(Halfedge(e), Halfedge(e + 1));
    if (is_pair) add_side(Halfedge(e + 4), Halfedge(e + 3));
    find_values(split, mesh_.child(i));
    result_.splits_[i] = {static_cast<std::uint32_t>(vanished_.size()),
                          static_cast<std::uint32_t>(result_.corner_changes_.size()),
                          static_cast<std::uint32_t>(result_.changed_wedges_.size())};
    for (const Halfedge h : kept_)
      merge_corner(h);
    for (std::size_t k = 0; k < sides_.size(); ++k)
      take_value(k);
    for (std::uint32_t h = e; h < e + (is_pair ? 6 : 3); ++h)
      --corners_of_wedge_[wedge(Halfedge(h)).index()];
    note_vanished();
  }

  /// Finds the corners that remain around the merged vertex, and the wedges before the split is
  /// undone of all corners that it touches. The order of the latter is that of ids of new wedges.
  void find_corners(std::uint32_t i, bool is_pair) {
    const VertexSplit& split = mesh_.splits()[i];
    const Halfedge e(3 * split.first_face);
    const auto beyond = [&](std::uint32_t corner) { return Halfedge(e.index() + corner); };
    kept_.clear();
    for (const Halfedge h : halfedges_around(mesh_.mesh(), split.parent)) {
      if (h != beyond(1) && !(is_pair && h == beyond(3))) kept_.push_back(h);
    }
    const std::size_t stays = kept_.size();
    const std::span<const Halfedge> moved = mesh_.moved(i);
    kept_.insert(kept_.end(), moved.begin(), moved.end());
    touched_.clear();
    const auto touch = [&](Halfedge h) { touched_.push_back(wedge(h)); };
    touch(beyond(0));
    for (const Halfedge h : moved)
      touch(h);
    if (is_pair) touch(beyond(4));
    touch(beyond(1));
    if (is_pair) touch(beyond(3));
    for (std::size_t k = 0; k < stays; ++k)
      touch(kept_[k]);
    touch(beyond(2));
    if (is_pair) touch(beyond(5));
  }

  void add_side(Halfedge at_child, Halfedge at_parent) {
    Side side{.at_child = wedge(at_child), .at_parent = wedge(at_parent)};
    side.child_class = classes_.of(side.at_child);
    side.parent_class = classes_.of(side.at_parent);
    // A line that ends at the parent has one class there, so both sides are one.
    if (sides_.empty() || sides_[0].parent_class != side.parent_class)
      return sides_.push_back(side);
    extra_child_class_ = side.child_class;
  }

  /// Computes the values of the merged vertex.
  void find_values(const VertexSplit& split, Vertex child) {
    std::array<std::vector<FaceShare>*, 2> shares{&shares_[0], &shares_[1]};
    std::array<MergedSide, 2> merged;
    const glm::dvec3 p(split.coarse_position);
    const bool is_nearer_child = glm::distance(p, glm::dvec3(split.child_position)) <
                                 glm::distance(p, glm::dvec3(split.fine_position));
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      const Side& side = sides_[k];
      shares[k]->clear();
      add_shares(child, side.child_class, p, *shares[k]);
      if (k == 0 && extra_child_class_ != kNone && extra_child_class_ != side.child_class)
        add_shares(child, extra_child_class_, p, *shares[k]);
      add_shares(split.parent, side.parent_class, p, *shares[k]);
      merged[k] = {*shares[k], side.at_child, side.at_parent,
                   is_nearer_child ? side.at_child : side.at_parent};
    }
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      const MergedSide* across = sides_.size() == 2 ? &merged[1 - k] : nullptr;
      store_values(split, merged[k], across, k);
    }
  }

  void store_values(const VertexSplit& split, const MergedSide& side, const MergedSide* across,
                    std::size_t k) {
    std::optional<Wedge> kept;
    if (split.coarse_position == split.fine_position)
      kept = side.at_parent;
    else if (split.coarse_position == split.child_position)
      kept = side.at_child;
    if (kept && classes_.is_mixed(*kept)) kept.reset();
    for (std::size_t l = 0; l < result_.arrays_.layers.size(); ++l) {
      const AttributeLayer& from = result_.arrays_.layers[l];
      if (kept) {
        std::ranges::copy(from.value(kept->index()), merged_values_[l].value(k).begin());
      } else {
        store_merged(from, side, across, merged_values_[l], k);
      }
    }
  }

  void add_shares(Vertex v, std::uint32_t wedge_class, const glm::dvec3& p,
                  std::vector<FaceShare>& to) {
    const Mesh& mesh = mesh_.mesh();
    for (const Halfedge h : halfedges_around(mesh, v)) {
      if (classes_.of(wedge(h)) != wedge_class) continue;
      const std::array<Halfedge, 3> around{h, Mesh::next(h), Mesh::prev(h)};
      std::array<glm::dvec3, 3> corners;
      std::array<Wedge, 3> wedges;
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] = glm::dvec3(mesh.position(mesh.origin(around[c])));
        wedges[c] = wedge(around[c]);
      }
      to.push_back(face_share(corners, wedges, p));
    }
  }

  Side* side_of(std::uint32_t wedge_class) {
    for (Side& side : sides_) {
      if (side.contains(wedge_class)) return &side;
    }
    return wedge_class == extra_child_class_ ? &sides_[0] : nullptr;
  }

  /// Gives a corner that remains the wedge of its side. The first corner of a side chooses it;
  /// those of the parent come first.
  void merge_corner(Halfedge h) {
    Wedge& its = wedge(h);
    Side* const side = side_of(classes_.of(its));
    if (side == nullptr) return;
    if (!side->merged.is_valid()) side->merged = its;
    if (its == side->merged) return;
    result_.corner_changes_.push_back({h, its});
    --corners_of_wedge_[its.index()];
    its = side->merged;
    ++corners_of_wedge_[its.index()];
  }

  void take_value(std::size_t k) {
    const Wedge w = sides_[k].merged;
    if (!w.is_valid()) return;
    classes_.isolate(w);
    bool changes = false;
    for (std::size_t l = 0; l < result_.arrays_.layers.size() && !changes; ++l)
      changes = !std::ranges::equal(result_.arrays_.layers[l].value(w.index()),
                                    merged_values_[l].value(k));
    if (!changes) return;
    const std::size_t slot = result_.changed_wedges_.size();
    result_.changed_wedges_.push_back(w);
    for (std::size_t l = 0; l < result_.arrays_.layers.size(); ++l) {
      result_.others_[l].resize(slot + 1);
      std::ranges::copy(result_.arrays_.layers[l].value(w.index()),
                        result_.others_[l].value(slot).begin());
      std::ranges::copy(merged_values_[l].value(k),
                        result_.arrays_.layers[l].value(w.index()).begin());
    }
  }

  void note_vanished() {
    for (const Wedge w : touched_) {
      if (corners_of_wedge_[w.index()] != 0) continue;
      corners_of_wedge_[w.index()] = kNone;
      vanished_.push_back(w);
    }
    extra_child_class_ = kNone;
  }

  /// Renumbers wedges in order of appearance, and turns the lists around: they were gathered from
  /// the last split to the first.
  void put_in_order() {
    if (result_.arrays_.layers.empty()) return;
    Array<Wedge> old_id;  // by new id
    Array<Wedge> new_id(corners_of_wedge_.size());
    std::fill(new_id.begin(), new_id.end(), Wedge{});
    const auto name = [&](Wedge w) {
      if (new_id[w.index()].is_valid()) return;
      new_id[w.index()] = Wedge(static_cast<std::uint32_t>(old_id.size()));
      old_id.push_back(w);
    };
    for (std::size_t h = 0; h < 3 * std::size_t{mesh_.base_face_count()}; ++h)
      name(result_.arrays_.corner_wedge[h]);
    Array<CornerChange> corners;
    Array<Wedge> values;
    Array<std::uint32_t> old_slot;
    corners.reserve(result_.corner_changes_.size());
    values.reserve(result_.changed_wedges_.size());
    old_slot.reserve(result_.changed_wedges_.size());
    Ends end{static_cast<std::uint32_t>(vanished_.size()),
             static_cast<std::uint32_t>(result_.corner_changes_.size()),
             static_cast<std::uint32_t>(result_.changed_wedges_.size())};
    // The parts of the first split are the last ones.
    for (ProgressiveAttributes::Split& split : result_.splits_) {
      const Ends begin{split.first_wedge, split.first_corner, split.first_value};
      split = {static_cast<std::uint32_t>(old_id.size()),
               static_cast<std::uint32_t>(corners.size()),
               static_cast<std::uint32_t>(values.size())};
      for (std::uint32_t k = begin.wedge; k < end.wedge; ++k)
        name(vanished_[k]);
      corners.insert(corners.end(), result_.corner_changes_.begin() + begin.corner,
                     result_.corner_changes_.begin() + end.corner);
      for (std::uint32_t k = begin.value; k < end.value; ++k) {
        values.push_back(result_.changed_wedges_[k]);
        old_slot.push_back(k);
      }
      end = begin;
    }
    const auto rename = [&](Wedge& w) { w = new_id[w.index()]; };
    for (CornerChange& change : corners)
      rename(change.other);
    for (Wedge& w : values)
      rename(w);
    for (Wedge& w : result_.arrays_.corner_wedge)
      rename(w);
    result_.full_wedges_ = static_cast<std::uint32_t>(old_id.size());
    result_.corner_changes_ = std::move(corners);
    result_.changed_wedges_ = std::move(values);
    for (std::size_t l = 0; l < result_.arrays_.layers.size(); ++l) {
      reorder(result_.arrays_.layers[l], old_id, [](Wedge w) { return w.index(); });
      reorder(result_.others_[l], old_slot, [](std::uint32_t slot) { return slot; });
    }
  }

  template <class Id, class Index>
  static void reorder(AttributeLayer& layer, const Array<Id>& old, Index index) {
    AttributeLayer ordered(layer.type(), old.size());
    parallel_for(old.size(), kCornerGrain, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i)
        std::ranges::copy(std::as_const(layer).value(index(old[i])), ordered.value(i).begin());
    });
    layer = std::move(ordered);
  }

  struct Ends {
    std::uint32_t wedge, corner, value;
  };

  ProgressiveMesh& mesh_;
  WedgeClasses classes_;
  ProgressiveAttributes result_;
  Array<std::uint32_t> corners_of_wedge_;      ///< at the current level; kNone: vanished
  Array<Wedge> vanished_;                      ///< in the order of undoing
  std::vector<AttributeLayer> merged_values_;  ///< of up to two sides
  std::vector<Side> sides_;
  std::uint32_t extra_child_class_ = kNone;  ///< of the right side, if both sides are one
  std::array<std::vector<FaceShare>, 2> shares_;
  std::vector<Halfedge> kept_;  ///< corners that remain around the merged vertex
  std::vector<Wedge> touched_;
};

ProgressiveAttributes record_attributes(ProgressiveMesh& mesh, const Mesh& full,
                                        std::span<const Halfedge> face_source,
                                        const Attributes& attributes, Progress* progress) {
  return AttributeRecorder(mesh, full, face_source, attributes).run(progress);
}

}  // namespace mesher::progressive
