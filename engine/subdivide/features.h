#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/masks.h"
#include "engine/subdivide/options.h"

namespace mesher {

/// A sharp edge of a level: a crease, or a boundary.
struct SharpEdge {
  Halfedge h;  ///< either, or the one without twin
  float sharpness = 0.0F;
  std::array<float, 2> left{};  ///< what its halves keep: at the origin of `h`, at its target
  std::array<std::uint32_t, 2> end{};  ///< its ends as indices into Features::vertices
};

/// A vertex that is sharp itself or ends sharp edges.
struct SharpVertex {
  Vertex v;
  float own = 0.0F;         ///< its own sharpness
  std::uint32_t begin = 0;  ///< its sharp edges: `count` indices into Features::edges, listed from
  std::uint32_t count = 0;  ///< `begin` on in Features::incident
  VertexKind kind = VertexKind::smooth;
};

/// All that is sharp on one level, sparse: subdivision treats everything as smooth first and then
/// corrects what is listed here. A level's list follows from the list before by arithmetic: the
/// edge vertices of sharp edges are the only new sharp vertices, and each ends two halves of one
/// edge. O(sharp edges) in memory and time on every level but the first, which is found by a scan.
class Features {
 public:
  std::span<const SharpEdge> edges() const { return edges_; }
  std::span<const SharpVertex> vertices() const { return vertices_; }
  /// The sharp edges at a vertex, as indices into `edges()`.
  std::span<const std::uint32_t> at(const SharpVertex& vertex) const {
    return {incident_.data() + vertex.begin, vertex.count};
  }
  /// Vertices from here on were made on an edge: a crease through one has three faces on each side.
  std::uint32_t first_regular() const { return first_regular_; }
  /// 0 where the vertex is the origin of the edge's half-edge, 1 where it is its target.
  std::size_t side(const SharpEdge& edge, const SharpVertex& vertex) const {
    return &vertices_[edge.end[0]] == &vertex ? 0 : 1;
  }
  /// The vertex at the other end.
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

/// How many edges are creases or boundaries. O(F).
std::size_t count_sharp_edges(const Mesh& mesh);
/// Bytes that a level's list takes for each of them, and what making the next one takes beside.
inline constexpr std::size_t kBytesASharpEdge =
    sizeof(SharpEdge) + sizeof(SharpVertex) + 4 * sizeof(std::uint32_t);

/// What is sharp on the mesh as it is given. O(F + sharp edges log sharp edges).
Features features_of(const Mesh& mesh, const SubdivideOptions& options);

/// What is sharp on the level `finer`, which was made of the level with `features`. O(sharp edges).
/// Pre: `finer` has its twins.
Features next_features(const Features& features, const Level& finer,
                       const SubdivideOptions& options);

}  // namespace mesher
