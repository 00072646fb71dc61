#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/subdivide/options.h"

namespace mesher::test {

using Point = glm::dvec3;
using Triangle = std::array<std::uint32_t, 3>;
/// The lower index first.
using VertexPair = std::pair<std::uint32_t, std::uint32_t>;

inline constexpr double kForEver = std::numeric_limits<double>::infinity();
/// A sharpness of the engine as the references count it.
inline double settled(float sharpness) {
  return sharpness >= subdivide::kSharpForEver ? kForEver : double(sharpness);
}

inline VertexPair pair_of(std::uint32_t a, std::uint32_t b) {
  return a < b ? VertexPair(a, b) : VertexPair(b, a);
}

/// A mesh as a list of triangles and a table of sharp edges. The oracles subdivide it in double
/// precision, without the data structures of the engine.
struct PlainMesh {
  std::vector<Point> positions;
  std::vector<Triangle> triangles;
  /// All edges with a sharpness above zero, including boundary edges.
  std::map<VertexPair, double> sharpness;
  std::vector<double> vertex_sharpness;  ///< one per vertex
};

/// Converts a mesh and lists everything that is sharp by rule as infinitely sharp: boundary edges,
/// edges from kSharpForEver on, copies of bow-tie vertices and, depending on `boundary`, vertices
/// with one face.
PlainMesh plain_mesh(const Mesh& mesh, subdivide::BoundaryRounding boundary);

/// Diagonal of the bounding box; 1 if it is empty.
double diagonal(std::span<const Point> positions);

/// Largest distance between points of equal index. Pre: both have the same size.
double largest_distance(std::span<const Point> a, std::span<const Point> b);

std::vector<Point> points_of(std::span<const glm::vec3> positions);

/// Adjacency of vertices and edges, found by scanning all triangles.
struct Adjacency {
  /// Edges in the order in which a walk over the faces and their edges ab, bc, ca finds them.
  std::vector<VertexPair> edges;
  std::map<VertexPair, std::uint32_t> edge_index;
  std::vector<std::vector<std::uint32_t>> opposite;  ///< third vertices of the faces of an edge
  /// Neighbors counterclockwise; on the boundary from one end to the other.
  std::vector<std::vector<std::uint32_t>> ring;
  std::vector<std::uint32_t> faces_at;

  bool is_boundary(std::uint32_t v) const { return faces_at[v] + 1 == ring[v].size(); }
};

Adjacency adjacency(const PlainMesh& mesh);

/// Four children per triangle, in the order that the engine guarantees. The caller fills in
/// positions and sharpness.
std::vector<Triangle> split_triangles(const PlainMesh& mesh, const Adjacency& near);

/// Sharpness of an edge; 0 if the table does not list it.
double sharpness_of(const PlainMesh& mesh, std::uint32_t a, std::uint32_t b);

}  // namespace mesher::test
