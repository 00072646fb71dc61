#include "tests/subdivide/butterfly_oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mesher::test {
namespace {

/// Weight of neighbor j around an extraordinary vertex of valence n, counted from the edge.
double weight(std::size_t j, std::size_t n) {
  if (n == 3) return j == 0 ? 5.0 / 12.0 : -1.0 / 12.0;
  if (n == 4) return j == 0 ? 3.0 / 8.0 : (j == 2 ? -1.0 / 8.0 : 0.0);
  const double angle = 2.0 * std::numbers::pi * double(j) / double(n);
  return (0.25 + std::cos(angle) + 0.5 * std::cos(2.0 * angle)) / double(n);
}

class Butterfly {
 public:
  explicit Butterfly(const PlainMesh& mesh) : mesh_(mesh), near_(adjacency(mesh)) {}

  const Adjacency& near() const { return near_; }

  Point on_edge(std::uint32_t a, std::uint32_t b) const {
    if (opposite(a, b).size() == 1) return on_boundary(a, b);
    const bool is_odd_a = is_extraordinary(a);
    const bool is_odd_b = is_extraordinary(b);
    if (is_odd_a && is_odd_b) return 0.5 * (from(a, b) + from(b, a));
    if (is_odd_a) return from(a, b);
    if (is_odd_b) return from(b, a);
    return regular(a, b);
  }

 private:
  const Point& at(std::uint32_t v) const { return mesh_.positions[v]; }
  const std::vector<std::uint32_t>& opposite(std::uint32_t a, std::uint32_t b) const {
    return near_.opposite[near_.edge_index.at(pair_of(a, b))];
  }
  bool is_extraordinary(std::uint32_t v) const {
    return !near_.is_boundary(v) && near_.ring[v].size() != 6;
  }

  Point from(std::uint32_t v, std::uint32_t other) const {
    const std::vector<std::uint32_t>& ring = near_.ring[v];
    const std::size_t n = ring.size();
    const auto start =
        static_cast<std::size_t>(std::find(ring.begin(), ring.end(), other) - ring.begin());
    Point sum = 0.75 * at(v);
    for (std::size_t j = 0; j < n; ++j)
      sum += weight(j, n) * at(ring[(start + j) % n]);
    return sum;
  }

  /// The vertex across the edge a-b from `c`, or its reflection where there is none.
  Point wing(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    for (const std::uint32_t v : opposite(a, b)) {
      if (v != c) return at(v);
    }
    return at(a) + at(b) - at(c);
  }

  Point regular(std::uint32_t a, std::uint32_t b) const {
    Point sum = 0.5 * (at(a) + at(b));
    for (const std::uint32_t c : opposite(a, b))
      sum += at(c) / 8.0 - (wing(a, c, b) + wing(b, c, a)) / 16.0;
    return sum;
  }

  /// The far end of the boundary edge that continues at `v`.
  Point next_on_boundary(std::uint32_t v, std::uint32_t previous) const {
    const std::vector<std::uint32_t>& ring = near_.ring[v];
    return at(ring.front() == previous ? ring.back() : ring.front());
  }

  Point on_boundary(std::uint32_t a, std::uint32_t b) const {
    return (9.0 * (at(a) + at(b)) - next_on_boundary(a, b) - next_on_boundary(b, a)) / 16.0;
  }

  const PlainMesh& mesh_;
  Adjacency near_;
};

template <class OnEdge>
PlainMesh refined(const PlainMesh& mesh, const Adjacency& near, const OnEdge& on_edge) {
  PlainMesh fine;
  fine.triangles = split_triangles(mesh, near);
  fine.positions = mesh.positions;
  for (const auto& [a, b] : near.edges)
    fine.positions.push_back(on_edge(a, b));
  fine.vertex_sharpness.assign(fine.positions.size(), 0.0);
  return fine;
}

}  // namespace

PlainMesh refine_butterfly(const PlainMesh& mesh) {
  const Butterfly butterfly(mesh);
  return refined(mesh, butterfly.near(),
                 [&](std::uint32_t a, std::uint32_t b) { return butterfly.on_edge(a, b); });
}

PlainMesh refine_midpoint(const PlainMesh& mesh) {
  return refined(mesh, adjacency(mesh), [&](std::uint32_t a, std::uint32_t b) {
    return 0.5 * (mesh.positions[a] + mesh.positions[b]);
  });
}

}  // namespace mesher::test
