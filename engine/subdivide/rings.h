#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/array.h"
#include "engine/subdivide/level.h"

namespace mesher::subdivide {

/// The half-edges out of each vertex on any level, without a walk around it. Those of the mesh's
/// own vertices are listed once; their descendants follow by arithmetic. A vertex that was made on
/// an edge has six, in the children of the edge's two faces.
class Rings {
 public:
  /// Builds the rings of the mesh. `for_each_spoke` needs `lists_spokes`, which takes 4 bytes per
  /// half-edge. O(F).
  Rings(const LevelView& base, bool lists_spokes);

  /// Moves to the next level; call it after each step. `vertices`: the number of vertices of the
  /// level that was refined.
  void descend(std::uint32_t vertices) { first_of_level_.push_back(vertices); }

  bool lists_spokes() const { return !spokes_.empty(); }

  std::uint32_t base_vertices() const { return static_cast<std::uint32_t>(start_.size() - 1); }
  /// Returns the number of faces at a vertex of the mesh, which is the valence of an interior one.
  std::uint32_t base_valence(std::uint32_t v) const { return start_[v + 1] - start_[v]; }

  /// Calls `visit(Halfedge)` for the half-edges out of `v` by increasing index, which is the order
  /// in which a walk over all faces visits them. O(valence). Pre: v is not on a boundary; `level`
  /// is the current level.
  template <class Visit>
  void for_each_spoke(const LevelView& level, Vertex v, Visit visit) const;

 private:
  std::uint32_t levels_since_creation(Vertex v) const {
    std::uint32_t levels = 0;
    while (v.index() < first_of_level_[first_of_level_.size() - 1 - levels])
      ++levels;
    return levels;
  }

  std::vector<std::uint32_t> first_of_level_{0};
  Array<std::uint32_t> start_;  ///< the first spoke of each vertex, then the end of the last one's
  Array<Halfedge> spokes_;
};

template <class Visit>
void Rings::for_each_spoke(const LevelView& level, Vertex v, Visit visit) const {
  const std::uint32_t levels = levels_since_creation(v);
  const std::uint32_t shift = 2 * levels;  // first_half(h) is 4h
  if (v.index() < base_vertices()) {
    for (std::uint32_t i = start_[v.index()]; i < start_[v.index() + 1]; ++i)
      visit(Halfedge(spokes_[i].index() << shift));
    return;
  }
  // The spokes at the level at which the vertex was made: three in the children of each of the two
  // faces, by the edge's corner in that face.
  static constexpr std::array<std::array<std::uint32_t, 3>, 3> kSpokes{
      {{1, 3, 9}, {5, 7, 10}, {2, 6, 11}}};
  static constexpr std::array<std::uint32_t, 4> kCornerOfChild{2, 0, 1, 0};
  const Halfedge half = level.outgoing[v.index()];
  Halfedge other = level.twin[half.index()];
  for (std::uint32_t i = 0; i < levels; ++i)
    other = whole_of_second(other);
  const std::uint32_t child = (half.index() >> shift) / 3;
  const std::uint32_t twin = other.index() / 4;
  std::array<std::uint32_t, 2> face{child / 4, twin / 3};
  std::array<std::uint32_t, 2> corner{kCornerOfChild[child % 4], twin % 3};
  const std::uint32_t low = face[0] < face[1] ? 0 : 1;
  for (const std::uint32_t side : {low, 1 - low}) {
    for (const std::uint32_t spoke : kSpokes[corner[side]])
      visit(Halfedge((12 * face[side] + spoke) << shift));
  }
}

}  // namespace mesher::subdivide
