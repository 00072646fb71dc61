#include "tests/subdivide/plain_mesh.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace mesher::test {
namespace {

/// Orders the neighbors of a vertex. The faces give pairs of consecutive neighbors.
std::vector<std::uint32_t> ring_of(const std::map<std::uint32_t, std::uint32_t>& after) {
  if (after.empty()) return {};
  std::uint32_t first = after.begin()->first;
  for (const auto& [a, b] : after) {
    const bool is_end = std::none_of(after.begin(), after.end(),
                                     [&, v = a](const auto& other) { return other.second == v; });
    if (is_end) first = a;
  }
  std::vector<std::uint32_t> ring{first};
  for (auto at = after.find(first); at != after.end(); at = after.find(at->second)) {
    if (at->second == first) break;
    ring.push_back(at->second);
  }
  return ring;
}

}  // namespace

PlainMesh plain_mesh(const Mesh& mesh, subdivide::BoundaryRounding boundary) {
  PlainMesh plain;
  plain.positions = points_of(mesh.positions());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    plain.vertex_sharpness.push_back(settled(mesh.sharpness(Vertex(v))));
  for (const BowTieCopy& copy : mesh.bow_tie_copies())
    plain.vertex_sharpness[copy.v.index()] = kForEver;
  std::map<VertexPair, int> faces_of;
  std::vector<int> faces_at(mesh.vertex_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    Triangle triangle;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Halfedge h = Mesh::halfedge(Face(f), k);
      triangle[k] = mesh.origin(h).index();
      const VertexPair edge = pair_of(triangle[k], mesh.target(h).index());
      ++faces_of[edge];
      ++faces_at[triangle[k]];
      if (mesh.sharpness(h) > 0.0F) plain.sharpness[edge] = settled(mesh.sharpness(h));
    }
    plain.triangles.push_back(triangle);
  }
  for (const auto& [edge, count] : faces_of) {
    if (count == 1) plain.sharpness[edge] = kForEver;
  }
  if (boundary == subdivide::BoundaryRounding::edge_and_corner) {
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
      if (faces_at[v] == 1) plain.vertex_sharpness[v] = kForEver;
    }
  }
  return plain;
}

double diagonal(std::span<const Point> positions) {
  if (positions.empty()) return 1.0;
  Point low = positions.front();
  Point high = low;
  for (const Point& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double length = glm::distance(low, high);
  return length > 0.0 ? length : 1.0;
}

double largest_distance(std::span<const Point> a, std::span<const Point> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double distance = glm::distance(a[i], b[i]);
    // Not std::max, which would ignore a NaN distance.
    if (!(distance <= largest)) largest = distance;
  }
  return largest;
}

std::vector<Point> points_of(std::span<const glm::vec3> positions) {
  return {positions.begin(), positions.end()};
}

Adjacency adjacency(const PlainMesh& mesh) {
  Adjacency near;
  const std::size_t vertices = mesh.positions.size();
  near.faces_at.resize(vertices);
  std::vector<std::map<std::uint32_t, std::uint32_t>> after(vertices);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      const std::uint32_t c = t[(k + 2) % 3];
      const auto [place, is_new] =
          near.edge_index.try_emplace(pair_of(a, b), std::uint32_t(near.edges.size()));
      if (is_new) {
        near.edges.push_back(pair_of(a, b));
        near.opposite.emplace_back();
      }
      near.opposite[place->second].push_back(c);
      after[a][b] = c;
      ++near.faces_at[a];
    }
  }
  for (const auto& pairs : after)
    near.ring.push_back(ring_of(pairs));
  return near;
}

std::vector<Triangle> split_triangles(const PlainMesh& mesh, const Adjacency& near) {
  const auto old_vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto between = [&](std::uint32_t a, std::uint32_t b) {
    return old_vertices + near.edge_index.at(pair_of(a, b));
  };
  std::vector<Triangle> children;
  children.reserve(4 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = between(a, b);
    const std::uint32_t bc = between(b, c);
    const std::uint32_t ca = between(c, a);
    children.insert(children.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return children;
}

double sharpness_of(const PlainMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const auto place = mesh.sharpness.find(pair_of(a, b));
  return place == mesh.sharpness.end() ? 0.0 : place->second;
}

}  // namespace mesher::test
