#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/mesh.h"
#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// A wedge of a split: one that the parent had before it, or a new one.
struct SplitWedge {
  Wedge wedge;  ///< the id; of a new wedge, once all corners are known
  bool is_new = false;
  Vertex owner;  ///< its vertex after the split; none: no corner has it yet
  /// Index of the parent's wedge from which its value is predicted: itself, unless it is new.
  /// kNone: the value of `near` is the prediction.
  std::uint32_t source = kNone;
  Wedge near;
  // Of a wedge that the parent had:
  std::uint32_t at_child = kNone;   ///< the wedge that its corners at the child got last
  std::uint32_t at_parent = kNone;  ///< the same at the parent
  std::uint32_t staying = 0;        ///< number of its corners that stay at the parent
  std::uint32_t first_corner = kNone;
};

/// A corner of an old face at the parent or child. Wedges are indices into SplitWedges::wedges.
struct SplitCorner {
  Halfedge corner;
  std::uint32_t before = kNone;
  std::uint32_t after = kNone;
  std::uint32_t next = kNone;  ///< the next corner with the same wedge before the split
};

/// The corners of a split and their wedges. Reused to avoid allocations.
class SplitWedges {
 public:
  /// Gathers the corners at the parent before split `i`, with their wedges. O(faces at the parent).
  /// Pre: `mesh` is at the level after the split, `attributes` before it.
  void gather(const ProgressiveMesh& mesh, std::uint32_t i,
              const ProgressiveAttributes& attributes) {
    wedges.clear();
    corners.clear();
    const VertexSplit& split = mesh.splits()[i];
    first_face_corner = 3 * split.first_face;
    is_pair = mesh.face_count(i + 1) - split.first_face == 2;
    const std::span<const Wedge> before = attributes.corner_wedges();
    for (const Halfedge h : mesh.moved(i))
      add(h, before[h.index()]);
    moved = static_cast<std::uint32_t>(corners.size());
    for (const Halfedge h : halfedges_around(mesh.mesh(), split.parent)) {
      if (h.index() >= first_face_corner) continue;
      add(h, before[h.index()]);
      ++wedges[corners.back().before].staying;
    }
    old_wedges = static_cast<std::uint32_t>(wedges.size());
  }

  /// Returns the index of a wedge, or kNone.
  std::uint32_t find(Wedge w) const {
    if (w.index() >= slot_.size()) return kNone;
    const std::uint32_t slot = slot_[w.index()];
    return slot < wedges.size() && wedges[slot].wedge == w ? slot : kNone;
  }
  /// Returns the corner of a half-edge, or null. O(corners).
  const SplitCorner* corner(Halfedge h) const {
    for (const SplitCorner& c : corners) {
      if (c.corner == h) return &c;
    }
    return nullptr;
  }
  /// Adds a new wedge. An encoder knows its id.
  std::uint32_t add_new(Wedge w) {
    const auto index = static_cast<std::uint32_t>(wedges.size());
    SplitWedge& added = wedges.emplace_back();
    added.is_new = true;
    added.wedge = w;
    if (w.is_valid()) remember(w, index);
    return index;
  }

  std::vector<SplitWedge> wedges;    ///< first those that the parent had
  std::vector<SplitCorner> corners;  ///< first those that move to the child
  std::uint32_t moved = 0;
  std::uint32_t old_wedges = 0;
  std::uint32_t first_face_corner = 0;
  bool is_pair = false;

 private:
  void add(Halfedge h, Wedge w) {
    std::uint32_t index = find(w);
    if (index == kNone) {
      index = static_cast<std::uint32_t>(wedges.size());
      SplitWedge& added = wedges.emplace_back();
      added.wedge = w;
      added.source = index;
      added.near = w;
      remember(w, index);
    }
    corners.push_back({.corner = h, .before = index, .next = wedges[index].first_corner});
    wedges[index].first_corner = static_cast<std::uint32_t>(corners.size()) - 1;
  }
  void remember(Wedge w, std::uint32_t index) {
    if (w.index() >= slot_.size()) slot_.resize(w.index() + std::size_t{1}, 0);
    slot_[w.index()] = index;
  }

  /// By wedge, its index, if that wedge is there (P. Briggs, L. Torczon, "An efficient
  /// representation for sparse sets", 1993).
  Array<std::uint32_t> slot_;
};

}  // namespace mesher::progressive
