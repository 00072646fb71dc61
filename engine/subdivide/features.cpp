#include "engine/subdivide/features.h"

#include <algorithm>
#include <utility>

#include "engine/subdivide/sharpness.h"

namespace mesher::subdivide {
namespace {

/// Returns whether there are three faces on each side of the crease, or on the only side.
bool is_regular_crease(const LevelView& level, Vertex v, Halfedge a, Halfedge b) {
  const auto runs_along = [&](Halfedge h, Halfedge sharp) {
    return h == sharp || level.twin[h.index()] == sharp;
  };
  const Halfedge start = level.outgoing[v.index()];
  std::uint32_t faces = 0;
  std::uint32_t sharp_at[2] = {0, 0};
  std::uint32_t found = 0;
  Halfedge h = start;
  do {
    if (runs_along(h, a) || runs_along(h, b)) {
      if (found < 2) sharp_at[found] = faces;
      ++found;
    }
    ++faces;
    if (faces > 6) return false;
    h = level.twin[Mesh::prev(h).index()];
  } while (h.is_valid() && h != start);
  if (!h.is_valid()) return faces == 3;
  return faces == 6 && found == 2 && sharp_at[1] - sharp_at[0] == 3;
}

}  // namespace

/// Builds a Features in this order: edges; vertices, each followed by its incident edges; derived
/// data.
class FeatureBuilder {
 public:
  /// Vertices from `first_regular` on are edge vertices of some earlier level.
  FeatureBuilder(const SubdivideOptions& options, std::uint32_t first_regular) : options_(options) {
    features_.first_regular_ = first_regular;
  }

  /// Reserves memory for exactly these numbers.
  void reserve(std::size_t edges, std::size_t vertices) {
    features_.edges_.reserve(edges);
    features_.incident_.reserve(2 * edges);
    features_.vertices_.reserve(vertices);
  }
  void add_edge(Halfedge h, float sharpness) {
    features_.edges_.push_back(
        {.h = h, .sharpness = sharpness >= kSharpForEver ? kInfinitelySharp : sharpness});
  }
  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(features_.edges_.size()); }

  /// Adds a vertex. Its edges follow, through `add_incident`.
  void add_vertex(Vertex v, float own) {
    features_.vertices_.push_back(
        {.v = v, .own = own, .begin = static_cast<std::uint32_t>(features_.incident_.size())});
  }
  void add_incident(std::uint32_t edge, std::size_t side) {
    features_.incident_.push_back(edge);
    SharpVertex& vertex = features_.vertices_.back();
    ++vertex.count;
    features_.edges_[edge].end[side] =
        static_cast<std::uint32_t>(&vertex - features_.vertices_.data());
  }
  bool last_is_smooth() const {
    const SharpVertex& vertex = features_.vertices_.back();
    return vertex.count == 0 && vertex.own <= 0.0F;
  }
  void drop_last() { features_.vertices_.pop_back(); }

  Features finish(const LevelView& level) && {
    for (SharpVertex& vertex : features_.vertices_)
      vertex.kind = kind_of(level, vertex);
    for (SharpVertex& vertex : features_.vertices_)
      decay_edges_at(vertex);
    return std::move(features_);
  }

 private:
  VertexKind kind_of(const LevelView& level, const SharpVertex& vertex) const {
    if (vertex.own > 0.0F || vertex.count > 2) return VertexKind::corner;
    if (vertex.count < 2) return vertex.count == 1 ? VertexKind::dart : VertexKind::smooth;
    if (options_.creases == CreaseRules::derose98) return VertexKind::crease;
    if (vertex.v.index() >= features_.first_regular_) return VertexKind::regular_crease;
    const auto edges = features_.at(vertex);
    const bool is_regular = is_regular_crease(level, vertex.v, features_.edges_[edges[0]].h,
                                              features_.edges_[edges[1]].h);
    return is_regular ? VertexKind::regular_crease : VertexKind::crease;
  }

  /// Sets the next sharpness of the edge halves at the vertex.
  void decay_edges_at(const SharpVertex& vertex) {
    SemiSharpSum sum;
    for (const std::uint32_t i : features_.at(vertex))
      sum.add(features_.edges_[i].sharpness);
    for (const std::uint32_t i : features_.at(vertex)) {
      SharpEdge& edge = features_.edges_[i];
      edge.left[features_.side(edge, vertex)] = options_.decay == CreaseDecay::chaikin
                                                    ? chaikin_decayed(edge.sharpness, sum)
                                                    : decayed(edge.sharpness);
    }
  }

  const SubdivideOptions& options_;
  Features features_;
};

namespace {

/// Returns a vertex's own sharpness on the unsubdivided mesh. Copies of a bow-tie vertex are
/// infinitely sharp, or they would drift apart.
float own_sharpness(const Mesh& mesh, Vertex v, const SubdivideOptions& options) {
  if (mesh.is_isolated(v)) return 0.0F;
  if (mesh.is_bow_tie_copy(v)) return kInfinitelySharp;
  const Halfedge h = mesh.outgoing(v);
  const bool has_one_face = mesh.is_boundary(h) && !mesh.rotate_ccw(h).is_valid();
  if (has_one_face && options.boundary == BoundaryRounding::edge_and_corner) {
    return kInfinitelySharp;
  }
  const float own = mesh.sharpness(v);
  return own >= kSharpForEver ? kInfinitelySharp : own;
}

/// Returns whether `h` is the lower half-edge of a crease, or a boundary.
bool is_sharp_edge(const Mesh& mesh, Halfedge h) {
  if (mesh.is_boundary(h)) return true;
  return mesh.sharpness(h) > 0.0F && h < mesh.twin(h);
}

/// An end of a sharp edge; sorting groups them by vertex.
struct EdgeEnd {
  Vertex v;
  std::uint32_t edge = 0;
  std::uint32_t side = 0;
};

}  // namespace

std::size_t count_sharp_edges(const Mesh& mesh) {
  std::size_t count = 0;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    count += is_sharp_edge(mesh, Halfedge(h)) ? 1U : 0U;
  return count;
}

Features features_of(const Mesh& mesh, const SubdivideOptions& options) {
  FeatureBuilder builder(options, mesh.vertex_count());
  const std::size_t sharp = count_sharp_edges(mesh);
  std::vector<EdgeEnd> ends;
  ends.reserve(2 * sharp);
  builder.reserve(sharp, 2 * sharp);
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    if (!is_sharp_edge(mesh, h)) continue;
    const bool is_boundary = mesh.is_boundary(h);
    ends.push_back({mesh.origin(h), builder.edge_count(), 0});
    ends.push_back({mesh.target(h), builder.edge_count(), 1});
    builder.add_edge(h, is_boundary ? kInfinitelySharp : mesh.sharpness(h));
  }
  for (std::uint32_t v = 0; v < mesh.vertex_sharpnesses().size(); ++v) {
    if (mesh.sharpness(Vertex(v)) > 0.0F) ends.push_back({Vertex(v), kNone, 0});
  }
  for (const BowTieCopy& copy : mesh.bow_tie_copies())
    ends.push_back({copy.v, kNone, 0});
  std::ranges::sort(ends, {}, [](const EdgeEnd& end) { return std::pair(end.v, end.edge); });
  for (std::size_t i = 0; i < ends.size();) {
    const Vertex v = ends[i].v;
    builder.add_vertex(v, own_sharpness(mesh, v, options));
    for (; i < ends.size() && ends[i].v == v; ++i) {
      if (ends[i].edge != kNone) builder.add_incident(ends[i].edge, ends[i].side);
    }
    if (builder.last_is_smooth()) builder.drop_last();
  }
  return std::move(builder).finish(view_of(mesh));
}

Features next_features(const Features& features, const Level& finer,
                       const SubdivideOptions& options) {
  FeatureBuilder builder(options, features.first_regular());
  std::vector<std::array<std::uint32_t, 2>> halves(features.edges().size(), {kNone, kNone});
  builder.reserve(2 * halves.size(), features.vertices().size() + halves.size());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const SharpEdge& edge = features.edges()[i];
    for (std::size_t side = 0; side < 2; ++side) {
      if (edge.left[side] <= 0.0F) continue;
      halves[i][side] = builder.edge_count();
      builder.add_edge(side == 0 ? first_half(edge.h) : second_half(edge.h), edge.left[side]);
    }
  }
  for (const SharpVertex& vertex : features.vertices()) {
    builder.add_vertex(vertex.v, decayed(vertex.own));
    for (const std::uint32_t i : features.at(vertex)) {
      const std::size_t side = features.side(features.edges()[i], vertex);
      if (halves[i][side] != kNone) builder.add_incident(halves[i][side], side);
    }
    if (builder.last_is_smooth()) builder.drop_last();
  }
  for (std::size_t i = 0; i < halves.size(); ++i) {
    if (halves[i][0] == kNone && halves[i][1] == kNone) continue;
    builder.add_vertex(edge_vertex(finer, features.edges()[i].h), 0.0F);
    // The first half ends at the new vertex; the second half begins there.
    if (halves[i][0] != kNone) builder.add_incident(halves[i][0], 1);
    if (halves[i][1] != kNone) builder.add_incident(halves[i][1], 0);
  }
  return std::move(builder).finish(finer.view());
}

}  // namespace mesher::subdivide
