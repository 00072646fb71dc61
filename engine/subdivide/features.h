#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/masks.h"
#include "engine/subdivide/options.h"

namespace mesher::subdivide {

/// A sharp edge of a level: a crease, or a boundary.
struct SharpEdge {
  Halfedge h;  ///< either half-edge, or the one without twin
  float sharpness = 0.0F;
  std::array<float, 2> left{};  ///< sharpness of its halves on the next level: at the origin of
                                ///< `h`, at its target
  std::array<std::uint32_t, 2> end{};  ///< its ends as indices into Features::vertices
};

/// A vertex that is sharp itself or is the end of sharp edges.
struct SharpVertex {
  Vertex v;
  float own = 0.0F;         ///< its own sharpness
  std::uint32_t begin = 0;  ///< index of its first sharp edge in Features::incident_
  std::uint32_t count = 0;  ///< number of its sharp edges
  VertexKind kind = VertexKind::smooth;
};

/// The sharp edges and vertices of one level, as sparse lists. Subdivision first treats everything
/// as smooth and then corrects the listed edges and vertices. The lists of the next level follow by
/// arithmetic: its only new sharp vertices are the edge vertices of sharp edges, each the end of
/// the two halves of one edge. O(sharp edges) in memory and time on every level except the first,
/// which takes a scan of the mesh.
class Features {
 public:
  std::span<const SharpEdge> edges() const { return edges_; }
  std::span<const SharpVertex> vertices() const { return vertices_; }
  /// Returns the sharp edges at a vertex, as indices into `edges()`.
  std::span<const std::uint32_t> at(const SharpVertex& vertex) const {
    return {incident_.data() + vertex.begin, vertex.count};
  }
  /// Returns the first vertex that was made on an edge. A crease through such a vertex has three
  /// faces on each side.
  std::uint32_t first_regular() const { return first_regular_; }
  /// Returns 0 if the vertex is the origin of the edge's half-edge, 1 if it is its target.
  std::size_t side(const SharpEdge& edge, const SharpVertex& vertex) const {
    return &vertices_[edge.end[0]] == &vertex ? 0 : 1;
  }
  /// Returns the vertex at the other end.
  const SharpVertex& other_end(const SharpEdge& edge, const SharpVertex& vertex) const {
    return vertices_[edge.end[1 - side(edge, vertex)]];
  }

 private:
  friend class FeatureBuilder;
  std::vector<SharpEdge> edges_;
  std::vector<SharpVertex> vertices_;
  std::vector<std::uint32_t> incident_;
  std::uint32_t first_regular_ = 0;
};

/// Returns the number of edges that are creases or boundaries. O(F).
std::size_t count_sharp_edges(const Mesh& mesh);
/// The bytes per sharp edge: its entries in a level's lists, and scratch for the next level.
inline constexpr std::size_t kBytesPerSharpEdge =
    sizeof(SharpEdge) + sizeof(SharpVertex) + 4 * sizeof(std::uint32_t);

/// Returns the features of the unsubdivided mesh. O(F + sharp edges log sharp edges).
Features features_of(const Mesh& mesh, const SubdivideOptions& options);

/// Returns the features of `finer`, the next level after the one with `features`. O(sharp edges).
/// Pre: `finer` has its twins.
Features next_features(const Features& features, const Level& finer,
                       const SubdivideOptions& options);

}  // namespace mesher::subdivide
