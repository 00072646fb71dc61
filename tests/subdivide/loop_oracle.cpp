#include "tests/subdivide/loop_oracle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace mesher::test {
namespace {

/// A vertex, its neighbors in order and the sharpness there. The new positions of the vertex and of
/// the points on its edges depend on nothing else.
struct Star {
  Point center{};
  double own_sharpness = 0.0;
  bool is_boundary = false;
  std::vector<Point> ring;
  std::vector<double> spoke;  ///< sharpness of the edge to each neighbor
};

enum class Rule { smooth, crease, corner };

std::size_t count_sharp(const std::vector<double>& sharpness) {
  return static_cast<std::size_t>(
      std::count_if(sharpness.begin(), sharpness.end(), [](double s) { return s > 0.0; }));
}

/// A dart follows the rule of smooth vertices.
Rule rule_of(double own_sharpness, const std::vector<double>& spoke) {
  const std::size_t sharp = count_sharp(spoke);
  if (own_sharpness > 0.0 || sharp > 2) return Rule::corner;
  return sharp == 2 ? Rule::crease : Rule::smooth;
}

Kind kind_of(const Star& star) {
  const Rule rule = rule_of(star.own_sharpness, star.spoke);
  if (rule == Rule::corner) return Kind::corner;
  const std::size_t n = star.ring.size();
  if (rule == Rule::smooth) return count_sharp(star.spoke) == 1 ? Kind::dart : Kind::smooth;
  if (star.is_boundary) return n == 4 ? Kind::regular_crease : Kind::other_crease;
  bool is_regular = n == 6;
  for (std::size_t i = 0; i < n && is_regular; ++i)
    is_regular = (star.spoke[i] > 0.0) == (star.spoke[(i + 3) % 6] > 0.0);
  return is_regular ? Kind::regular_crease : Kind::other_crease;
}

double loop_weight(std::size_t n) {
  const double c = std::cos(2.0 * std::numbers::pi / double(n));
  return 3.0 / 8.0 + (3.0 / 8.0 + c / 4.0) * (3.0 / 8.0 + c / 4.0);
}

/// Applies the mask of a rule. `spoke` identifies the two edges of a crease.
Point masked(const Star& star, Rule rule, const std::vector<double>& spoke) {
  if (rule == Rule::corner) return star.center;
  if (rule == Rule::crease) {
    Point ends(0.0);
    for (std::size_t i = 0; i < star.ring.size(); ++i) {
      if (spoke[i] > 0.0) ends += star.ring[i];
    }
    return 0.75 * star.center + ends / 8.0;
  }
  const double a = loop_weight(star.ring.size());
  Point sum(0.0);
  for (const Point& p : star.ring)
    sum += p;
  return a * star.center + (1.0 - a) / double(star.ring.size()) * sum;
}

std::vector<double> child_spokes(const std::vector<double>& spoke, subdivide::CreaseDecay decay) {
  std::vector<double> child;
  for (std::size_t i = 0; i < spoke.size(); ++i) {
    std::vector<double> others = spoke;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    child.push_back(child_sharpness(spoke[i], others, decay));
  }
  return child;
}

/// Weight of the parent's rule where sharpness has just decayed to zero.
double parent_weight(const Star& star, double child_own, const std::vector<double>& child) {
  std::vector<double> fallen;
  if (star.own_sharpness > 0.0 && child_own == 0.0) fallen.push_back(star.own_sharpness);
  for (std::size_t i = 0; i < child.size(); ++i) {
    if (star.spoke[i] > 0.0 && child[i] == 0.0) fallen.push_back(star.spoke[i]);
  }
  double sum = 0.0;
  for (const double s : fallen)
    sum += s;
  return fallen.empty() ? 1.0 : std::min(1.0, sum / double(fallen.size()));
}

Point new_center(const Star& star, double child_own, const std::vector<double>& child) {
  if (star.ring.empty()) return star.center;
  const Rule parent_rule = rule_of(star.own_sharpness, star.spoke);
  const Rule child_rule = rule_of(child_own, child);
  const Point by_parent = masked(star, parent_rule, star.spoke);
  if (parent_rule == Rule::smooth || parent_rule == child_rule) return by_parent;
  const double w = parent_weight(star, child_own, child);
  return w * by_parent + (1.0 - w) * masked(star, child_rule, child);
}

/// An edge with everything that its new point depends on.
struct EdgeSite {
  Point a{};
  Point b{};
  std::vector<Point> opposite;
  double sharpness = 0.0;
  double child_at_a = 0.0;
  double child_at_b = 0.0;
  Kind kind_a = Kind::smooth;
  Kind kind_b = Kind::smooth;
};

Point new_point(const EdgeSite& edge, const OracleRules& rules) {
  const auto smooth = [&] {
    return 3.0 / 8.0 * (edge.a + edge.b) + (edge.opposite.at(0) + edge.opposite.at(1)) / 8.0;
  };
  if (edge.sharpness == 0.0) return smooth();
  const double way = rules.sharp_edge(edge.kind_a, edge.kind_b);
  // A boundary edge has only one opposite vertex and never ends in a dart.
  const Point sharp = way < 0.0 ? smooth() : (1.0 - way) * edge.a + way * edge.b;
  if (edge.child_at_a > 0.0 && edge.child_at_b > 0.0) return sharp;
  const double s = rules.overshoots ? edge.sharpness : std::min(edge.sharpness, 1.0);
  return s == 1.0 ? sharp : s * sharp + (1.0 - s) * smooth();
}

Star star_of(const PlainMesh& mesh, const Adjacency& near, std::uint32_t v) {
  Star star{.center = mesh.positions[v],
            .own_sharpness = mesh.vertex_sharpness[v],
            .is_boundary = near.is_boundary(v)};
  for (const std::uint32_t other : near.ring[v]) {
    star.ring.push_back(mesh.positions[other]);
    star.spoke.push_back(sharpness_of(mesh, v, other));
  }
  return star;
}

/// The star of a vertex whose neighbors all lie on edges of the previous level, so a crease
/// continues straight through them.
struct OldStar : Star {
  std::vector<double> beyond;  ///< sharpness of the edge beyond each neighbor

  /// The same star one level deeper.
  OldStar refined(const OracleRules& rules) const;
};

OldStar OldStar::refined(const OracleRules& rules) const {
  OldStar child;
  child.is_boundary = is_boundary;
  child.own_sharpness = child_sharpness(own_sharpness, {}, subdivide::CreaseDecay::uniform);
  child.spoke = child_spokes(spoke, rules.decay);
  child.center = new_center(*this, child.own_sharpness, child.spoke);
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    EdgeSite edge{.a = center, .b = ring[i], .sharpness = spoke[i], .child_at_a = child.spoke[i]};
    const bool is_first = is_boundary && i == 0;
    const bool is_last = is_boundary && i + 1 == n;
    if (!is_first) edge.opposite.push_back(ring[(i + n - 1) % n]);
    if (!is_last) edge.opposite.push_back(ring[(i + 1) % n]);
    edge.child_at_b = child_sharpness(spoke[i], {&beyond[i], 1}, rules.decay);
    edge.kind_a = kind_of(*this);
    // A point on an edge has valence 6, or 4 on the boundary.
    edge.kind_b = beyond[i] > 0.0 ? Kind::regular_crease : Kind::dart;
    child.ring.push_back(new_point(edge, rules));
    child.beyond.push_back(edge.child_at_b);
  }
  return child;
}

OldStar old_star_of(const PlainMesh& mesh, const Adjacency& near, std::uint32_t v) {
  OldStar star;
  static_cast<Star&>(star) = star_of(mesh, near, v);
  for (const std::uint32_t middle : near.ring[v]) {
    double beyond = 0.0;
    for (const std::uint32_t other : near.ring[middle]) {
      if (other != v) beyond = std::max(beyond, sharpness_of(mesh, middle, other));
    }
    star.beyond.push_back(beyond);
  }
  return star;
}

OldStar at_the_limit(OldStar star, const OracleRules& rules) {
  // Each level brings the neighbors nearer by a factor of 5/8 or better. This number of levels
  // reaches double precision.
  constexpr int kLevels = 90;
  for (int level = 0; level < kLevels; ++level)
    star = star.refined(rules);
  return star;
}

/// Whether the normals of the faces converge within few levels. This holds for stars with few
/// faces, but not at corners, where a wide sector may fold.
bool is_told_soon(const OldStar& star) {
  constexpr std::size_t kMostNeighbours = 9;
  constexpr std::size_t kMostOnASide = 4;
  const Kind kind = kind_of(star);
  const std::size_t n = star.ring.size();
  if (n < 2 || kind == Kind::corner) return false;
  if (kind == Kind::smooth || kind == Kind::dart) return n <= kMostNeighbours;
  if (star.is_boundary) return n - 1 <= kMostOnASide;
  std::vector<std::size_t> sharp;
  for (std::size_t i = 0; i < n; ++i) {
    if (star.spoke[i] > 0.0) sharp.push_back(i);
  }
  const std::size_t side = sharp[1] - sharp[0];
  return std::max(side, n - side) <= kMostOnASide;
}

/// Normals of the faces around the star as they shrink, summed from crease to crease. There is one
/// per face, indexed by the position of its first neighbor in the ring.
std::vector<Point> side_normals(const OldStar& star) {
  const std::size_t n = star.ring.size();
  const std::size_t faces = star.is_boundary ? n - 1 : n;
  std::vector<std::size_t> side(faces);
  std::vector<Point> sum(1, Point(0.0));
  std::size_t start = 0;
  while (start < n && star.spoke[start] == 0.0)
    ++start;
  start = start == n ? 0 : start;
  for (std::size_t k = 0; k < faces; ++k) {
    const std::size_t i = (start + k) % n;
    if (k > 0 && star.spoke[i] > 0.0) sum.emplace_back(0.0);
    side[i] = sum.size() - 1;
    sum.back() += glm::cross(star.ring[i] - star.center, star.ring[(i + 1) % n] - star.center);
  }
  std::vector<Point> normals;
  for (const std::size_t s : side)
    normals.push_back(glm::normalize(sum[s]));
  return normals;
}

/// Keyed by the neighbor that comes first, counterclockwise, in each face.
std::map<std::uint32_t, Point> normals_around(const PlainMesh& mesh, const Adjacency& near,
                                              std::uint32_t v, const OracleRules& rules) {
  // Enough levels to converge. With more, the fastest component, which shrinks to a quarter per
  // level, would be lost in rounding.
  constexpr int kLevels = 36;
  if (near.ring[v].empty()) return {};
  OldStar star = old_star_of(mesh, near, v);
  // Coordinates relative to the limit, so that differences keep their precision as they shrink.
  const Point limit = at_the_limit(star, rules).center;
  star.center -= limit;
  for (Point& p : star.ring)
    p -= limit;
  for (int level = 0; level < kLevels; ++level)
    star = star.refined(rules);
  if (!is_told_soon(star)) return {};
  const std::vector<Point> normals = side_normals(star);
  std::map<std::uint32_t, Point> by_neighbour;
  for (std::size_t i = 0; i < normals.size(); ++i)
    by_neighbour[near.ring[v][i]] = normals[i];
  return by_neighbour;
}

}  // namespace

double child_sharpness(double sharpness, std::span<const double> others,
                       subdivide::CreaseDecay decay) {
  if (sharpness == 0.0 || sharpness == kForEver) return sharpness;
  double sum = 0.0;
  int count = 0;
  for (const double other : others) {
    if (other == 0.0 || other == kForEver) continue;
    sum += other;
    ++count;
  }
  if (decay == subdivide::CreaseDecay::uniform || count == 0) return std::max(sharpness - 1.0, 0.0);
  return std::max(0.75 * sharpness + 0.25 * sum / count - 1.0, 0.0);
}

PlainMesh refine(const PlainMesh& mesh, const OracleRules& rules) {
  const Adjacency near = adjacency(mesh);
  PlainMesh fine;
  fine.triangles = split_triangles(mesh, near);
  const auto old_vertices = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<Kind> kind;
  for (std::uint32_t v = 0; v < old_vertices; ++v) {
    const Star star = star_of(mesh, near, v);
    const double own = child_sharpness(star.own_sharpness, {}, subdivide::CreaseDecay::uniform);
    const std::vector<double> child = child_spokes(star.spoke, rules.decay);
    kind.push_back(kind_of(star));
    fine.positions.push_back(new_center(star, own, child));
    fine.vertex_sharpness.push_back(own);
    for (std::size_t i = 0; i < child.size(); ++i) {
      const std::uint32_t edge = near.edge_index.at(pair_of(v, near.ring[v][i]));
      if (child[i] > 0.0) fine.sharpness[pair_of(v, old_vertices + edge)] = child[i];
    }
  }
  for (std::uint32_t e = 0; e < near.edges.size(); ++e) {
    const auto [a, b] = near.edges[e];
    EdgeSite edge{.a = mesh.positions[a],
                  .b = mesh.positions[b],
                  .sharpness = sharpness_of(mesh, a, b),
                  .child_at_a = sharpness_of(fine, a, old_vertices + e),
                  .child_at_b = sharpness_of(fine, b, old_vertices + e),
                  .kind_a = kind[a],
                  .kind_b = kind[b]};
    for (const std::uint32_t v : near.opposite[e])
      edge.opposite.push_back(mesh.positions[v]);
    fine.positions.push_back(new_point(edge, rules));
    fine.vertex_sharpness.push_back(0.0);
  }
  return fine;
}

std::vector<Point> limit_positions(const PlainMesh& mesh, const OracleRules& rules) {
  const PlainMesh fine = refine(mesh, rules);
  const Adjacency near = adjacency(fine);
  std::vector<Point> limit;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
    limit.push_back(at_the_limit(old_star_of(fine, near, v), rules).center);
  return limit;
}

std::vector<Point> limit_normals(const PlainMesh& mesh, const OracleRules& rules) {
  const PlainMesh fine = refine(mesh, rules);
  const Adjacency near = adjacency(fine);
  std::vector<std::map<std::uint32_t, Point>> normals;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
    normals.push_back(normals_around(fine, near, v, rules));
  std::vector<Point> result;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      // The child at the corner holds it at index k, and the first neighbor of the face at the next
      // index.
      const Triangle& child = fine.triangles[4 * f + k];
      const std::map<std::uint32_t, Point>& around = normals[child[k]];
      const auto place = around.find(child[(k + 1) % 3]);
      result.push_back(place == around.end() ? Point(0.0) : place->second);
    }
  }
  return result;
}

}  // namespace mesher::test
