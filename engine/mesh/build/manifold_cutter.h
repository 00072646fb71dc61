#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/parallel.h"
#include "engine/mesh/build/edge_matching.h"
#include "engine/mesh/build/report.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Makes matched triangles manifold, so that the invariants of Mesh hold. Crowded edges (three or
/// more faces) are paired around the edge, and vertices where several fans meet are split. If no
/// edge of the input joined the fans, the vertex was a bow-tie vertex, and its copies are listed as
/// such. If the surface was cut along an edge, the copies may move apart. Internal to building.
/// Pre: no duplicate faces; orientation is settled.
class ManifoldCutter {
 public:
  /// `mesh` has positions and origins. `vertex_source` maps each vertex to its source. Copies made
  /// by splitting are appended to both.
  ManifoldCutter(MeshArrays& mesh, Array<std::uint32_t>& vertex_source, BuildReport& report)
      : mesh_(mesh), vertex_source_(vertex_source), report_(report) {}

  /// Fills mesh.twin, mesh.outgoing and mesh.bow_tie_copies. O(F + V), plus O(k log k) per edge of
  /// k faces. Throws Cancelled.
  void run(EdgeMatching&& matching, Progress* progress);

 private:
  void cut_disagreeing(std::uint64_t expected);
  template <class Fetch, class Visit>
  void for_each_crowd(IndexRange range, Fetch fetch, Visit visit) const;
  void pair_crowds(Progress* progress);
  bool has_single_fans(Progress* progress) const;
  void separate_fans(Progress* progress);
  void find_fans(Progress* progress);
  template <class Visit>
  void visit_fan(Halfedge h, Visit visit) const;
  void cut_parallel_crowds(Progress* progress);
  std::vector<std::size_t> crowds_with_parallel_edges(Progress* progress) const;
  void rename_fan(Halfedge h);
  void split_vertices(Progress* progress);
  void list_bow_tie_copies();
  Array<Vertex> fans_joined_by_cut_edges() const;
  /// Returns the vertex of the input that `v` is a copy of, or `v` itself.
  Vertex before_split(Vertex v) const {
    return v.index() < original_vertices_ ? v : split_from_[v.index() - original_vertices_];
  }
  Vertex target(std::uint32_t h) const { return mesh_.origin[Mesh::next(Halfedge(h)).index()]; }

  MeshArrays& mesh_;
  Array<std::uint32_t>& vertex_source_;
  BuildReport& report_;
  EdgeMatching matching_;
  std::size_t original_vertices_ = 0;
  Array<std::uint32_t> fan_;                    ///< per half-edge: the lowest half-edge of its fan
  std::vector<Vertex> split_from_;              ///< per vertex past the original ones
  std::vector<std::uint32_t> cut_disagreeing_;  ///< pairs: each cut half-edge and its twin
};

}  // namespace mesher
