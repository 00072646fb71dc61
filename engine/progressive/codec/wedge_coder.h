#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "engine/core/array.h"
#include "engine/core/assert.h"
#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/codec/split_wedges.h"

namespace mesher::progressive {

/// Codes which wedge each corner has after a split. Usually the corners of a wedge that stay at the
/// parent keep it, those that move to the child get a new one together, and new faces continue the
/// wedges of the faces beside them.
class WedgeCoder {
 public:
  /// Wedges of the corners of the new faces.
  using NewCorners = std::array<Wedge, 6>;

  /// Codes split `i`, and sets the wedges of `s`, and those of the new faces. Returns what is
  /// wrong, or an empty string. Pre: `s` was gathered; `mesh` and `source` (which is null for a
  /// decoder) are at the level after the split, `built` before it.
  template <class Coder>
  std::string_view code(Coder& coder, const ProgressiveMesh& mesh, std::uint32_t i,
                        const ProgressiveAttributes& built, const ProgressiveAttributes* source,
                        SplitWedges& s, NewCorners& corners);

  /// Notes the vertex of a wedge.
  void note(Wedge w, Vertex v) {
    if (w.index() >= vertex_.size()) vertex_.resize(w.index() + std::size_t{1});
    vertex_[w.index()] = v;
  }
  Vertex vertex(Wedge w) const {
    return w.index() < vertex_.size() ? vertex_[w.index()] : Vertex{};
  }

 private:
  /// The kinds of corners, with models of their own.
  enum Kind : std::size_t {
    kMoved,
    kMovedAgain,
    kStaying,
    kStayingAgain,
    kAtChild,
    kAtParent,
    kApex
  };

  struct Models {
    AdaptiveBitModel is_first, is_second, is_new;
  };
  /// The usual wedges of a corner; kNone: a new one.
  struct Candidates {
    std::uint32_t first = kNone;
    std::uint32_t second = kNone;
  };

  template <class Coder>
  std::uint32_t choose(Coder& coder, Models& models, const Candidates& usual, Wedge actual,
                       SplitWedges& s) {
    const std::uint32_t index = Coder::kDecodes ? 0 : s.find(actual);
    if (coder.bit(models.is_first, index == usual.first)) return chosen(usual.first, actual, s);
    const bool has_second = usual.second != usual.first;
    if (has_second && coder.bit(models.is_second, index == usual.second))
      return chosen(usual.second, actual, s);
    const bool may_be_new = usual.first != kNone && usual.second != kNone;
    if (may_be_new && coder.bit(models.is_new, index == kNone)) return chosen(kNone, actual, s);
    return coder.uniform(index, static_cast<std::uint32_t>(s.wedges.size()));
  }
  static std::uint32_t chosen(std::uint32_t index, Wedge actual, SplitWedges& s) {
    return index == kNone ? s.add_new(actual) : index;
  }

  /// Gives a wedge to a vertex. Returns false if it is another's.
  static bool own(SplitWedges& s, std::uint32_t index, Vertex v) {
    Vertex& owner = s.wedges[index].owner;
    if (!owner.is_valid()) owner = v;
    return owner == v;
  }

  template <class Coder>
  bool code_old(Coder& coder, SplitWedges& s, std::size_t c, Vertex v, Wedge actual);
  template <class Coder>
  bool code_new(Coder& coder, SplitWedges& s, Kind kind, Vertex v, const SplitCorner* across,
                const SplitCorner* beyond, Wedge actual, std::uint32_t& index, bool& is_across);
  template <class Coder>
  bool code_apex(Coder& coder, SplitWedges& s, Vertex v, Wedge first, Wedge second,
                 std::size_t context, Wedge actual, std::uint32_t wedges, std::uint32_t& index,
                 Wedge& wedge);

  template <class Coder>
  bool code_side(Coder& coder, const ProgressiveMesh& mesh, std::uint32_t i, std::uint32_t side,
                 const ProgressiveAttributes& built, const ProgressiveAttributes* source,
                 SplitWedges& s, std::array<std::uint32_t, 6>& index, NewCorners& corners);
  template <bool decodes>
  static void number_new(SplitWedges& s, const std::array<std::uint32_t, 6>& new_corners,
                         std::uint32_t next);

  Models models_[7][8];
  Array<Vertex> vertex_;  ///< by wedge
};

template <class Coder>
bool WedgeCoder::code_old(Coder& coder, SplitWedges& s, std::size_t c, Vertex v, Wedge actual) {
  const std::uint32_t before = s.corners[c].before;
  const bool moves = c < s.moved;
  const SplitWedge& old = s.wedges[before];
  const std::uint32_t last = moves ? old.at_child : old.at_parent;
  Candidates usual{last, before};
  if (last == kNone) {
    // A wedge stays with the parent if it has corners there.
    usual.first = moves && old.staying > 0 ? kNone : before;
    usual.second = usual.first == kNone ? before : kNone;
  }
  const Kind kind =
      moves ? (last == kNone ? kMoved : kMovedAgain) : (last == kNone ? kStaying : kStayingAgain);
  const std::size_t context = (s.old_wedges > 1 ? 1U : 0U) + (old.staying > 0 ? 2U : 0U);
  const std::uint32_t after = choose(coder, models_[kind][context], usual, actual, s);
  s.corners[c].after = after;
  (moves ? s.wedges[before].at_child : s.wedges[before].at_parent) = after;
  if (s.wedges[after].source == kNone) s.wedges[after].source = before;
  return own(s, after, v);
}

/// Codes a corner of a new face at the child or parent. `across` is the corner of the face on the
/// other side at the same vertex, and `beyond` the one that was across the edge that has opened.
template <class Coder>
bool WedgeCoder::code_new(Coder& coder, SplitWedges& s, Kind kind, Vertex v,
                          const SplitCorner* across, const SplitCorner* beyond, Wedge actual,
                          std::uint32_t& index, bool& is_across) {
  Candidates usual;
  if (across != nullptr) usual.first = across->after;
  if (beyond != nullptr) {
    const SplitWedge& old = s.wedges[beyond->before];
    usual.second = kind == kAtChild ? old.at_child : old.at_parent;
  }
  const bool is_seam = across != nullptr && beyond != nullptr && across->before != beyond->before;
  const std::size_t context = (s.old_wedges > 1 ? 1U : 0U) + (is_seam ? 2U : 0U) +
                              (kind == kAtParent && is_across ? 4U : 0U);
  index = choose(coder, models_[kind][context], usual, actual, s);
  is_across = index == usual.first;
  if (s.wedges[index].source == kNone) {
    const SplitCorner* from = beyond != nullptr ? beyond : across;
    s.wedges[index].source = from != nullptr ? from->before : 0;
  }
  return own(s, index, v);
}

template <class Coder>
bool WedgeCoder::code_apex(Coder& coder, SplitWedges& s, Vertex v, Wedge first, Wedge second,
                           std::size_t context, Wedge actual, std::uint32_t wedges,
                           std::uint32_t& index, Wedge& wedge) {
  Models& models = models_[kApex][context];
  wedge = first;
  if (coder.bit(models.is_first, actual == first)) return true;
  wedge = second;
  if (first != second && coder.bit(models.is_second, actual == second)) return true;
  if (coder.bit(models.is_new, actual.index() >= wedges)) {
    index = s.add_new(actual);
    s.wedges[index].owner = v;
    s.wedges[index].near = first;
    return true;
  }
  wedge = Wedge(coder.uniform(actual.index(), wedges));
  return vertex(wedge) == v;
}

/// Numbers the new wedges, from `next` on, in the order of their first corners. An encoder knows
/// the numbers.
template <bool decodes>
void WedgeCoder::number_new(SplitWedges& s, const std::array<std::uint32_t, 6>& new_corners,
                            std::uint32_t next) {
  const auto name = [&](std::uint32_t w) {
    if (w == kNone || !s.wedges[w].is_new) return;
    Wedge& id = s.wedges[w].wedge;
    const bool is_named = decodes ? id.is_valid() : id.index() < next;
    if (is_named) return;
    MESHER_ASSERT(decodes || id.index() == next);
    id = Wedge(next++);
  };
  name(new_corners[0]);
  for (std::size_t c = 0; c < s.moved; ++c)
    name(s.corners[c].after);
  name(new_corners[4]);
  name(new_corners[1]);
  name(new_corners[3]);
  for (std::size_t c = s.moved; c < s.corners.size(); ++c)
    name(s.corners[c].after);
  name(new_corners[2]);
  name(new_corners[5]);
}

/// Codes the corners of the new face on one side (0: left, 1: right). Returns false if a corner has
/// a wedge of another vertex.
template <class Coder>
bool WedgeCoder::code_side(Coder& coder, const ProgressiveMesh& mesh, std::uint32_t i,
                           std::uint32_t side, const ProgressiveAttributes& built,
                           const ProgressiveAttributes* source, SplitWedges& s,
                           std::array<std::uint32_t, 6>& index, NewCorners& corners) {
  const VertexSplit& split = mesh.splits()[i];
  const Vertex child = mesh.child(i);
  const std::uint32_t e = s.first_face_corner;
  const std::uint32_t wedges = built.wedge_count(i);
  const auto actual = [&](std::uint32_t h) {
    return Coder::kDecodes ? Wedge{} : source->corner_wedges()[h];
  };
  const auto corner_at = [&](Halfedge h) { return h.is_valid() ? s.corner(h) : nullptr; };
  const auto corner_after = [&](Halfedge h) {
    return h.is_valid() ? s.corner(Mesh::next(h)) : nullptr;
  };
  // The corners at the child, the parent and the apex are 0, 1 and 2 of the first face, and 1, 0
  // and 2 of the second.
  const std::uint32_t first = 3 * side;
  const std::uint32_t at_child = first + side;
  const std::uint32_t at_parent = first + 1 - side;
  const Halfedge near_parent = split.beyond[side == 0 ? 0 : 3];
  const Halfedge near_child = split.beyond[side == 0 ? 1 : 2];
  const SplitCorner* parent_corner = side == 0 ? corner_after(near_parent) : corner_at(near_parent);
  const SplitCorner* child_corner = side == 0 ? corner_at(near_child) : corner_after(near_child);
  bool is_as_child = false;
  if (!code_new(coder, s, kAtChild, child, child_corner, parent_corner, actual(e + at_child),
                index[at_child], is_as_child))
    return false;
  bool is_as_parent = is_as_child;
  if (!code_new(coder, s, kAtParent, split.parent, parent_corner, child_corner,
                actual(e + at_parent), index[at_parent], is_as_parent))
    return false;
  // The corners at the apex of the faces across the two new sides.
  const auto before = [&](Halfedge h, bool is_next) {
    return h.is_valid() ? built.corner_wedges()[(is_next ? Mesh::next(h) : h).index()] : Wedge{};
  };
  Wedge on_parent_side = before(near_parent, side == 1);
  Wedge on_child_side = before(near_child, side == 0);
  if (!on_parent_side.is_valid()) on_parent_side = on_child_side;
  if (!on_child_side.is_valid()) on_child_side = on_parent_side;
  if (is_as_child && !is_as_parent) std::swap(on_parent_side, on_child_side);
  const std::size_t context = (on_parent_side == on_child_side ? 0U : 1U) +
                              (is_as_child ? 2U : 0U) + (is_as_parent ? 4U : 0U);
  const Vertex apex = mesh.mesh().origin(Halfedge(e + first + 2));
  return code_apex(coder, s, apex, on_parent_side, on_child_side, context, actual(e + first + 2),
                   wedges, index[first + 2], corners[first + 2]);
}

template <class Coder>
std::string_view WedgeCoder::code(Coder& coder, const ProgressiveMesh& mesh, std::uint32_t i,
                                  const ProgressiveAttributes& built,
                                  const ProgressiveAttributes* source, SplitWedges& s,
                                  NewCorners& corners) {
  constexpr std::string_view why = "a corner has a wedge of another vertex";
  const VertexSplit& split = mesh.splits()[i];
  const Vertex child = mesh.child(i);
  const auto actual = [&](std::uint32_t h) {
    return Coder::kDecodes ? Wedge{} : source->corner_wedges()[h];
  };
  for (std::size_t c = 0; c < s.corners.size(); ++c) {
    const Vertex v = c < s.moved ? child : split.parent;
    if (!code_old(coder, s, c, v, actual(s.corners[c].corner.index()))) return why;
  }
  const std::uint32_t wedges = built.wedge_count(i);
  std::array<std::uint32_t, 6> index{kNone, kNone, kNone, kNone, kNone, kNone};
  for (std::uint32_t side = 0; side < (s.is_pair ? 2U : 1U); ++side) {
    if (!code_side(coder, mesh, i, side, built, source, s, index, corners)) return why;
  }
  for (std::uint32_t w = 0; w < s.old_wedges; ++w) {
    if (!s.wedges[w].owner.is_valid()) return "a split leaves a wedge without corners";
  }
  number_new<Coder::kDecodes>(s, index, wedges);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (index[c] != kNone) corners[c] = s.wedges[index[c]].wedge;
  }
  for (const SplitWedge& w : s.wedges)
    note(w.wedge, w.owner);
  return {};
}

}  // namespace mesher::progressive
