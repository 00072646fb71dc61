#include "engine/analysis/hausdorff.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "engine/analysis/skim.h"
#include "engine/analysis/triangle_reach.h"
#include "engine/core/array.h"
#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher {
namespace {

constexpr std::size_t kVerticesPerChunk = 1024;
constexpr std::size_t kFacesPerChunk = 512;
constexpr std::size_t kPiecesPerChunk = 256;
/// Pieces that are worked on between two looks at the lower bound, and splits of each.
constexpr std::size_t kPiecesPerWave = 1U << 15U;
constexpr std::size_t kMostOpen = 1U << 20U;  // 140 bytes each
constexpr int kSplitsOfFace = 3;
constexpr int kSplitsOfPiece = 16;
constexpr std::uint8_t kMostCuts = 12;
constexpr double kFlat = 32.0;
/// Vertices of which the first guess at the distance is taken.
constexpr std::size_t kProbes = 512;
constexpr int kMostSpokes = 16;
/// Part of the distance to decide upon that corners may use; what is left is for points between.
constexpr double kNearForDecision = 0.5;
/// Where something is known to be nearer than that part of the largest distance found so far, it
/// does not matter how near.
constexpr double kNearEnough = 0.25;

/// Where a side of a piece is split.
struct Split {
  std::size_t from;  ///< corner
  std::size_t to;
  double part;  ///< of the way
};

/// A triangle within a face.
struct Piece {
  Triangle corners;
  std::array<double, 3> distance;  ///< of each corner, at most
  std::array<Face, 3> near;        ///< a face of the other surface that is so far from it
  Face below;                      ///< one that is near the middle of the face, if one is known
  double upper = 0.0;              ///< bound for all points, where it is open
  std::uint8_t cuts = 0;           ///< along triangles that made it
  Face face;                       ///< of which it is a part
};

/// What came of some of the work.
struct Outcome {
  double lower = 0.0;  ///< the largest distance that was found
  double upper = 0.0;  ///< of what is done with
  std::uint64_t queries = 0;
  std::vector<Piece> open;    ///< what is not
  std::vector<Piece> beyond;  ///< what is known to be too far away
};

/// What decides whether a piece is done with; the same for all of a wave.
struct Limits {
  double near;     ///< distances below are not told apart
  double allowed;  ///< upper bounds up to here are good enough
  double beyond = std::numeric_limits<double>::infinity();  ///< distances at which to give up
};

double longest_coordinate(const Mesh& mesh) {
  float most = 0.0F;
  for (const Vertex v : mesh.origins()) {
    const glm::vec3 p = glm::abs(mesh.position(v));
    most = std::max({most, p.x, p.y, p.z});
  }
  return most;
}

glm::dvec3 corner(const Mesh& mesh, std::uint32_t face, std::uint32_t c) {
  return mesh.position(mesh.origin(Mesh::halfedge(Face(face), c)));
}

/// Where the piece crosses a plane through a side of the triangle and its normal, if it does.
std::optional<Split> crossing(const Triangle& piece, const Triangle& t) {
  constexpr double kOnIt = 1e-9;  // of the length of the side
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  for (std::size_t side = 0; side < 3; ++side) {
    const glm::dvec3 along = t[(side + 1) % 3] - t[side];
    const glm::dvec3 inward = glm::cross(normal, along);
    const double least = kOnIt * glm::length(inward) * glm::length(along);
    std::array<double, 3> inside;
    for (std::size_t c = 0; c < 3; ++c)
      inside[c] = glm::dot(inward, piece[c] - t[side]);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t next = (c + 1) % 3;
      if (std::max(inside[c], inside[next]) > least && std::min(inside[c], inside[next]) < -least) {
        return Split{c, next, inside[c] / (inside[c] - inside[next])};
      }
    }
  }
  return std::nullopt;
}

/// One direction: from a surface to another.
class OneSide {
 public:
  OneSide(const HausdorffSide& from, const HausdorffSide& to, double rounding)
      : mesh_(from.mesh),
        to_mesh_(to.mesh),
        hints_(from.hints),
        lazy_tree_(to.tree),
        rounding_(rounding) {}

  double lower() const { return lower_; }
  /// Of what is done with, and of what is not.
  double upper() const;
  /// Calls `visit` for what is too far away, or may be.
  template <class Visit>
  void visit_beyond(const Visit& visit) const {
    for (const std::vector<Piece>* pieces : {&open_, &beyond_}) {
      for (const Piece& piece : *pieces)
        visit(piece);
    }
  }
  bool has_open() const { return !is_begun_ || !open_.empty(); }
  std::uint64_t queries() const { return queries_; }

  /// Distances of some vertices, for a first guess.
  void probe();
  /// The largest distance of a vertex. Pre: there are hints.
  void find_farthest_vertex(Progress* progress);
  /// Finds vertices that are no farther than that, by hints alone.
  void find_near_vertices(double distance, Progress* progress);
  /// Bounds of all faces by `skim`. Pre: there are hints, and vertices that are near are known.
  void skim_faces(const Limits& limits, Progress* progress);
  /// Distances of all vertices; after `skim_faces`, of those of the faces that are not done with.
  void measure_vertices(const Limits& limits, Progress* progress);
  /// Looks at all faces the first time, later at some of what is open.
  void refine(const Limits& limits, Progress* progress);

 private:
  void note(const Outcome& outcome);
  Face hint(Vertex v, Face otherwise) const;
  bool is_near_hint(const glm::dvec3& p, Face near, double enough) const;
  void begin_faces(const Limits& limits, Progress* progress);
  TriangleTree::Nearest query(const glm::dvec3& p, Face hint, const Limits& limits,
                              Outcome& outcome, double off = 0.0) const;
  double certified(const Piece& piece, double computed) const;
  double bound(const Piece& piece, const Sides& sides, double allowed) const;
  double bound_by_triangles(const Piece& piece, double least) const;
  void split_up(const Piece& piece, int splits, const Limits& limits, Outcome& outcome) const;
  Piece piece_of(std::uint32_t face) const;

  const Mesh& mesh_;
  const Mesh& to_mesh_;
  std::span<const Face> hints_;
  LazyTree& lazy_tree_;
  const TriangleTree* to_ = nullptr;  ///< once it is needed
  double rounding_;
  std::optional<std::vector<Skimmed::Unclear>> unclear_;  ///< faces; nothing: all of them
  Array<std::uint8_t> is_near_;  ///< for each vertex: certainly no farther than near_distance_
  double near_distance_ = 0.0;
  Array<double> distance_;  ///< of each vertex, at most
  Array<Face> near_;        ///< and which face is so far away
  std::vector<Piece> open_;
  std::vector<Piece> beyond_;
  double lower_ = 0.0;
  double upper_ = 0.0;
  std::uint64_t queries_ = 0;
  bool is_begun_ = false;
};

/// The distance (not its square) of a point that may be `off` the surface by rounding.
TriangleTree::Nearest OneSide::query(const glm::dvec3& p, Face hint, const Limits& limits,
                                     Outcome& outcome, double off) const {
  TriangleTree::Nearest hit = to_->nearest_beyond(p, hint, limits.near * limits.near);
  hit.squared_distance = std::sqrt(hit.squared_distance);
  // Nearer ones need not be exact, and would not raise the bound.
  if (hit.squared_distance > limits.near) {
    outcome.lower = std::max(outcome.lower, hit.squared_distance - off);
  }
  ++outcome.queries;
  return hit;
}

void OneSide::note(const Outcome& outcome) {
  lower_ = std::max(lower_, outcome.lower);
  upper_ = std::max(upper_, outcome.upper);
  queries_ += outcome.queries;
  open_.insert(open_.end(), outcome.open.begin(), outcome.open.end());
  beyond_.insert(beyond_.end(), outcome.beyond.begin(), outcome.beyond.end());
}

/// A face of the other surface that is likely to be near a vertex.
Face OneSide::hint(Vertex v, Face otherwise) const {
  return hints_.empty() ? otherwise : hints_[Mesh::face(mesh_.outgoing(v)).index()];
}

void OneSide::probe() {
  to_ = &lazy_tree_.get();
  const std::size_t step = std::max<std::size_t>(1, mesh_.face_count() / kProbes);
  Outcome outcome;
  Face near(0);
  for (std::size_t f = 0; f < mesh_.face_count(); f += step) {
    const Vertex v = mesh_.origin(Mesh::halfedge(Face(static_cast<std::uint32_t>(f))));
    near = query(mesh_.position(v), hint(v, near), {}, outcome).face;
  }
  note(outcome);
}

/// Whether the hint, or a face at the corner of it that is nearest, is no farther than `enough`
/// (squared) from a point.
bool OneSide::is_near_hint(const glm::dvec3& p, Face near, double enough) const {
  const auto is_near = [&](Face f) {
    return squared_distance(p, {corner(to_mesh_, f.index(), 0), corner(to_mesh_, f.index(), 1),
                                corner(to_mesh_, f.index(), 2)}) <= enough;
  };
  if (is_near(near)) return true;
  const auto farness = [&](std::uint32_t c) {
    const glm::dvec3 q = corner(to_mesh_, near.index(), c) - p;
    return glm::dot(q, q);
  };
  std::uint32_t nearest = farness(0) < farness(1) ? 0 : 1;
  if (farness(2) < farness(nearest)) nearest = 2;
  const Vertex v = to_mesh_.origin(Mesh::halfedge(near, nearest));
  int spokes = 0;
  for (const Halfedge h : halfedges_around(to_mesh_, v)) {
    if (++spokes > kMostSpokes) break;
    if (is_near(Mesh::face(h))) return true;
  }
  return false;
}

void OneSide::find_farthest_vertex(Progress* progress) {
  to_ = &lazy_tree_.get();
  const std::size_t n = mesh_.vertex_count();
  const auto look_at = [&](std::size_t i, Outcome& outcome) {
    const Vertex v(static_cast<std::uint32_t>(i));
    if (mesh_.is_isolated(v)) return;
    // What is no farther than another one does not matter.
    const double near = outcome.lower;
    const Face hint = this->hint(v, {});
    if (is_near_hint(mesh_.position(v), hint, near * near)) return;
    query(mesh_.position(v), hint, {.near = near, .allowed = 0.0}, outcome);
  };
  Outcome first;
  for (std::size_t i = 0; i < n; i += n / kProbes + 1)
    look_at(i, first);
  note(first);
  std::vector<Outcome> outcomes(chunk_count(n, kVerticesPerChunk));
  parallel_chunks(n, kVerticesPerChunk, progress, [&](std::size_t chunk, IndexRange range) {
    outcomes[chunk].lower = lower_;
    for (std::size_t i = range.begin; i < range.end; ++i)
      look_at(i, outcomes[chunk]);
  });
  for (const Outcome& outcome : outcomes)
    note(outcome);
  is_near_.assign(n, 1);
  near_distance_ = lower_;
}

void OneSide::find_near_vertices(double distance, Progress* progress) {
  near_distance_ = distance;
  const std::size_t n = mesh_.vertex_count();
  is_near_.assign(n, 0);
  parallel_chunks(n, kVerticesPerChunk, progress, [&](std::size_t, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Vertex v(static_cast<std::uint32_t>(i));
      if (mesh_.is_isolated(v)) continue;
      const bool is_near = is_near_hint(mesh_.position(v), hint(v, {}), distance * distance);
      is_near_[i] = is_near ? 1 : 0;
    }
  });
}

void OneSide::skim_faces(const Limits& limits, Progress* progress) {
  const SkimInput input{.from = mesh_,
                        .to = to_mesh_,
                        .hints = hints_,
                        .is_near = is_near_,
                        .near = near_distance_,
                        .rounding = rounding_};
  Skimmed skimmed = skim(input, limits.allowed, progress);
  upper_ = std::max(upper_, skimmed.upper);
  unclear_ = std::move(skimmed.unclear);
}

void OneSide::measure_vertices(const Limits& limits, Progress* progress) {
  if (unclear_ && unclear_->empty()) return;
  to_ = &lazy_tree_.get();
  const std::size_t n = mesh_.vertex_count();
  distance_.resize(n);
  near_.resize(n);
  Array<bool> is_needed;
  if (unclear_) {
    is_needed.assign(n, false);
    for (const auto& [face, upper] : *unclear_) {
      for (std::uint32_t c = 0; c < 3; ++c)
        is_needed[mesh_.origin(Mesh::halfedge(face, c)).index()] = true;
    }
  }
  std::vector<Outcome> outcomes(chunk_count(n, kVerticesPerChunk));
  parallel_chunks(n, kVerticesPerChunk, progress, [&](std::size_t chunk, IndexRange range) {
    Face near(0);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Vertex v(static_cast<std::uint32_t>(i));
      if (mesh_.is_isolated(v) || (unclear_ && !is_needed[i])) continue;
      const TriangleTree::Nearest hit =
          query(mesh_.position(v), hint(v, near), limits, outcomes[chunk]);
      distance_[i] = hit.squared_distance;
      near_[i] = near = hit.face;
    }
  });
  for (const Outcome& outcome : outcomes)
    note(outcome);
}

Piece OneSide::piece_of(std::uint32_t face) const {
  Piece piece;
  piece.face = Face(face);
  for (std::uint32_t c = 0; c < 3; ++c) {
    const std::uint32_t v = mesh_.origin(Mesh::halfedge(Face(face), c)).index();
    piece.corners[c] = corner(mesh_, face, c);
    piece.distance[c] = distance_[v];
    piece.near[c] = near_[v];
  }
  return piece;
}

/// The largest distance from the corners to one triangle, the best of those that are near the
/// piece; or `least`, if that is less.
double OneSide::bound_by_triangles(const Piece& piece, double least) const {
  const std::array<Face, 4> near{piece.near[0], piece.near[1], piece.near[2], piece.below};
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (!near[i].is_valid() || std::find(&near[0], &near[i], near[i]) != &near[i]) continue;
    const Triangle triangle = to_->triangle(near[i]);
    double most = 0.0;
    for (std::size_t c = 0; c < 3 && most < least; ++c) {
      const double d = piece.near[c] == near[i]
                           ? piece.distance[c]
                           : std::sqrt(squared_distance(piece.corners[c], triangle));
      most = std::max(most, d);
    }
    least = std::min(least, most);
  }
  return least;
}

/// A computed bound, and what rounding may have taken from it. Nothing where both triangles are the
/// same to the last bit.
double OneSide::certified(const Piece& piece, double computed) const {
  if (computed == 0.0) {
    for (const Face f : {piece.near[0], piece.near[1], piece.near[2], piece.below}) {
      if (!f.is_valid()) continue;
      const Triangle near = to_->triangle(f);
      const auto is_corner = [&](const glm::dvec3& p) {
        return std::find(near.begin(), near.end(), p) != near.end();
      };
      if (std::all_of(piece.corners.begin(), piece.corners.end(), is_corner)) return 0.0;
    }
  }
  return computed * (1.0 + 1e-12) + rounding_;
}

/// A bound for all points of a piece; not the best, where a simpler one is good enough.
double OneSide::bound(const Piece& piece, const Sides& sides, double allowed) const {
  const double farthest = std::max({piece.distance[0], piece.distance[1], piece.distance[2]});
  const double by_corners = farthest + reach(sides);
  const double simple = certified(piece, by_corners);
  if (simple <= allowed) return simple;
  return certified(piece, bound_by_triangles(piece, by_corners));
}

/// Splits a piece, and its parts, until all are done with or the number of splits is used up.
void OneSide::split_up(const Piece& whole, int splits, const Limits& limits,
                       Outcome& outcome) const {
  std::array<Piece, kSplitsOfPiece + 1> stack;
  stack[0] = whole;
  for (std::size_t size = 1; size > 0;) {
    Piece& piece = stack[size - 1];
    const Sides sides = squared_sides(piece.corners);
    piece.upper = bound(piece, sides, limits.allowed);
    const double farthest = std::max({piece.distance[0], piece.distance[1], piece.distance[2]});
    const double longest_side = std::sqrt(std::max({sides[0], sides[1], sides[2]}));
    // Flat: halving would follow the sides of the triangles below down to the distance allowed.
    // Cut along them, what lies over one of them is bounded exactly. Not too often, though: slivers
    // would follow.
    const bool is_cut = piece.upper > limits.allowed && piece.cuts < kMostCuts &&
                        farthest < limits.allowed && longest_side > kFlat * limits.allowed;
    // The triangle below the middle bounds it exactly where it covers the whole piece. (It may be
    // the same one, and the distance no more than rounding.)
    const bool is_unclear = piece.upper > limits.allowed || piece.upper <= 2.0 * rounding_;
    if (is_cut || (is_unclear && piece.upper > 0.0 && !piece.below.is_valid())) {
      const glm::dvec3 middle = (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0;
      piece.below = query(middle, piece.near[0], limits, outcome, rounding_).face;
      piece.upper = std::min(piece.upper, bound(piece, sides, limits.allowed));
    }
    // Smaller ones than that cannot be told apart.
    if (piece.upper <= limits.allowed || longest_side <= rounding_) {
      outcome.upper = std::max(outcome.upper, piece.upper);
      --size;
      continue;
    }
    if (farthest > limits.beyond) {
      outcome.beyond.push_back(piece);
      --size;
      continue;
    }
    if (splits-- <= 0) {
      outcome.open.push_back(piece);
      --size;
      continue;
    }
    const auto longest =
        static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
    Split split{longest, (longest + 1) % 3, 0.5};
    if (is_cut) {
      const Triangle below = to_->triangle(piece.below);
      const Sides there = squared_sides(below);
      // A piece over many triangles is halved first.
      if (sides[longest] < 4.0 * std::max({there[0], there[1], there[2]})) {
        split = crossing(piece.corners, below).value_or(split);
        ++piece.cuts;
      }
    }
    const auto [from, to, part] = split;
    const glm::dvec3 p = piece.corners[from] + part * (piece.corners[to] - piece.corners[from]);
    const TriangleTree::Nearest hit = query(p, piece.near[from], limits, outcome, rounding_);
    Piece& other = stack[size++];
    other = piece;
    for (const auto& [half, end] : {std::pair(&piece, from), std::pair(&other, to)}) {
      half->corners[end] = p;
      half->distance[end] = hit.squared_distance;
      half->near[end] = hit.face;
    }
  }
}

void OneSide::refine(const Limits& limits, Progress* progress) {
  if (!is_begun_) return begin_faces(limits, progress);
  const auto count = static_cast<std::ptrdiff_t>(std::min(open_.size(), kPiecesPerWave));
  // First come, first served, so that all are looked at where the work is limited; the last first
  // where there are too many to keep.
  const auto first = open_.size() < kMostOpen ? open_.begin() : open_.end() - count;
  const std::vector<Piece> wave(first, first + count);
  open_.erase(first, first + count);
  std::vector<Outcome> outcomes(chunk_count(wave.size(), kPiecesPerChunk));
  parallel_chunks(wave.size(), kPiecesPerChunk, progress, [&](std::size_t chunk, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      split_up(wave[i], kSplitsOfPiece, limits, outcomes[chunk]);
  });
  for (const Outcome& outcome : outcomes)
    note(outcome);
}

void OneSide::begin_faces(const Limits& limits, Progress* progress) {
  is_begun_ = true;
  const std::size_t n = unclear_ ? unclear_->size() : mesh_.face_count();
  std::vector<Outcome> outcomes(chunk_count(n, kFacesPerChunk));
  parallel_chunks(n, kFacesPerChunk, progress, [&](std::size_t chunk, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      // What is allowed may have grown since the face was skimmed.
      const Skimmed::Unclear face =
          unclear_ ? (*unclear_)[i] : Skimmed::Unclear{Face(static_cast<std::uint32_t>(i))};
      if (face.upper <= limits.allowed) {
        outcomes[chunk].upper = std::max(outcomes[chunk].upper, face.upper);
      } else {
        split_up(piece_of(face.face.index()), kSplitsOfFace, limits, outcomes[chunk]);
      }
    }
  });
  for (const Outcome& outcome : outcomes)
    note(outcome);
}

double OneSide::upper() const {
  if (!is_begun_) return std::numeric_limits<double>::infinity();
  double most = std::max(lower_, upper_);
  for (const std::vector<Piece>* pieces : {&open_, &beyond_}) {
    for (const Piece& piece : *pieces)
      most = std::max(most, piece.upper);
  }
  return most;
}

/// Both directions, which share what is known of the larger distance.
class BothSides {
 public:
  BothSides(const HausdorffSide& a, const HausdorffSide& b, const HausdorffOptions& options)
      : options_(options),
        rounding_(0x1p-48 * std::max(longest_coordinate(a.mesh), longest_coordinate(b.mesh))),
        forward_(a, b, rounding_),
        backward_(b, a, rounding_),
        has_hints_(!a.hints.empty() && !b.hints.empty()) {}

  HausdorffBounds run() {
    begin_stage(options_.progress, "bounding the distance");
    if (has_hints_) {
      skim_both();
    } else {
      for (OneSide* side : {&forward_, &backward_})
        side->probe();
    }
    for (OneSide* side : {&forward_, &backward_})
      side->measure_vertices(limits(), options_.progress);
    while (is_open()) {
      for (OneSide* side : {&forward_, &backward_}) {
        if (side->has_open() && is_open()) side->refine(limits(), options_.progress);
      }
    }
    return {.forward = {forward_.lower(), forward_.upper()},
            .backward = {backward_.lower(), backward_.upper()},
            .beyond = options_.finds_all ? beyond() : std::vector<Face>{}};
  }

 private:
  /// The second tree, mostly also the first one of a decision, is never needed.
  void skim_both() {
    Progress* progress = options_.progress;
    if (options_.is_decision) {
      forward_.find_near_vertices(kNearForDecision * options_.enough, progress);
      backward_.find_near_vertices(kNearForDecision * options_.enough, progress);
    } else {
      forward_.find_farthest_vertex(progress);
      backward_.find_near_vertices(lower(), progress);
    }
    for (OneSide* side : {&forward_, &backward_})
      side->skim_faces(limits(), progress);
  }
  double lower() const { return std::max(forward_.lower(), backward_.lower()); }
  std::vector<Face> beyond() const {
    std::vector<Face> faces;
    forward_.visit_beyond([&](const Piece& piece) { faces.push_back(piece.face); });
    backward_.visit_beyond([&](const Piece& piece) {
      faces.insert(faces.end(), piece.near.begin(), piece.near.end());
      if (piece.below.is_valid()) faces.push_back(piece.below);
    });
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }
  Limits limits() const {
    const double known = options_.is_decision ? 0.0 : options_.ratio * lower();
    const double allowed = std::max({known, options_.enough, 2.0 * rounding_});
    if (!options_.finds_all) return {.near = kNearEnough * lower(), .allowed = allowed};
    return {.near = kNearEnough * std::min(lower(), options_.enough),
            .allowed = allowed,
            .beyond = options_.enough};
  }
  bool is_open() const {
    if (!forward_.has_open() && !backward_.has_open()) return false;
    if (options_.is_decision && !options_.finds_all && lower() > options_.enough) return false;
    return forward_.queries() + backward_.queries() < options_.most_queries;
  }

  const HausdorffOptions& options_;
  double rounding_;
  OneSide forward_;
  OneSide backward_;
  bool has_hints_;
};

}  // namespace

DistanceInterval HausdorffBounds::two_sided() const {
  return {.lower = std::max(forward.lower, backward.lower),
          .upper = std::max(forward.upper, backward.upper)};
}

HausdorffBounds hausdorff_bounds(const HausdorffSide& a, const HausdorffSide& b,
                                 const HausdorffOptions& options) {
  MESHER_ASSERT(a.mesh.face_count() > 0 && b.mesh.face_count() > 0);
  MESHER_ASSERT(options.ratio > 1.0);
  return BothSides(a, b, options).run();
}

HausdorffBounds hausdorff_bounds(const Mesh& a, const Mesh& b, const HausdorffOptions& options) {
  LazyTree tree_a(a);
  LazyTree tree_b(b);
  return hausdorff_bounds({a, tree_a}, {b, tree_b}, options);
}

}  // namespace mesher
