// The branch and bound of `hausdorff_bounds`, and the passes before it.
#include "engine/analysis/one_sided_bound.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher::analysis {
namespace {

constexpr std::size_t kVerticesPerChunk = 1024;
constexpr std::size_t kFacesPerChunk = 512;
constexpr std::size_t kPiecesPerChunk = 256;
/// The pieces processed between two updates of the lower bound, and the splits of each.
constexpr std::size_t kPiecesPerWave = 1U << 15U;
constexpr std::size_t kMostOpen = 1U << 20U;  // 140 bytes each
constexpr int kSplitsOfFace = 3;
constexpr int kSplitsOfPiece = 16;
constexpr std::uint8_t kMostCuts = 12;
constexpr double kFlat = 32.0;
/// The number of vertices for the first lower bound.
constexpr std::size_t kProbes = 512;
constexpr int kMostBoundSpokes = 16;

/// The position at which a side of a piece is split.
struct Split {
  std::size_t from;  ///< from this corner
  std::size_t to;
  double part;  ///< fraction of the side
};

glm::dvec3 corner(const Mesh& mesh, std::uint32_t face, std::uint32_t c) {
  return mesh.position(mesh.origin(Mesh::halfedge(Face(face), c)));
}

/// Returns where the piece crosses a plane through a side of the triangle and its normal, if it
/// does.
std::optional<Split> crossing(const Triangle& piece, const Triangle& t) {
  constexpr double kTolerance = 1e-9;  // relative to the length of the side
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  for (std::size_t side = 0; side < 3; ++side) {
    const glm::dvec3 along = t[(side + 1) % 3] - t[side];
    const glm::dvec3 inward = glm::cross(normal, along);
    const double least = kTolerance * glm::length(inward) * glm::length(along);
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

}  // namespace

/// Returns the nearest face, with its distance (not squared) in squared_distance. `off`: the
/// distance by which rounding may have moved the point off the surface.
TriangleTree::Nearest OneSidedBound::query(const glm::dvec3& p, Face hint,
                                           const BoundLimits& limits, BoundOutcome& outcome,
                                           double off) const {
  TriangleTree::Nearest hit = to_->nearest_beyond(p, hint, limits.near * limits.near);
  hit.squared_distance = std::sqrt(hit.squared_distance);
  // Distances up to `near` need not be exact, and would not raise the bound.
  if (hit.squared_distance > limits.near) {
    outcome.lower = std::max(outcome.lower, hit.squared_distance - off);
  }
  ++outcome.queries;
  return hit;
}

void OneSidedBound::note(const BoundOutcome& outcome) {
  lower_ = std::max(lower_, outcome.lower);
  upper_ = std::max(upper_, outcome.upper);
  queries_ += outcome.queries;
  open_.insert(open_.end(), outcome.open.begin(), outcome.open.end());
  beyond_.insert(beyond_.end(), outcome.beyond.begin(), outcome.beyond.end());
}

/// Returns a face of the other surface that is probably near a vertex.
Face OneSidedBound::hint(Vertex v, Face otherwise) const {
  return hints_.empty() ? otherwise : hints_[Mesh::face(mesh_.outgoing(v)).index()];
}

void OneSidedBound::probe() {
  to_ = &lazy_tree_.get();
  const std::size_t step = std::max<std::size_t>(1, mesh_.face_count() / kProbes);
  BoundOutcome outcome;
  Face near(0);
  for (std::size_t f = 0; f < mesh_.face_count(); f += step) {
    const Vertex v = mesh_.origin(Mesh::halfedge(Face(static_cast<std::uint32_t>(f))));
    near = query(mesh_.position(v), hint(v, near), {}, outcome).face;
  }
  note(outcome);
}

/// Returns whether the hint, or a face at its nearest corner, is within `enough` (squared) of a
/// point.
bool OneSidedBound::is_near_hint(const glm::dvec3& p, Face near, double enough) const {
  const auto is_near = [&](Face f) {
    return squared_distance(p, {corner(to_mesh_, f.index(), 0), corner(to_mesh_, f.index(), 1),
                                corner(to_mesh_, f.index(), 2)}) <= enough;
  };
  if (is_near(near)) return true;
  const auto squared_to_corner = [&](std::uint32_t c) {
    const glm::dvec3 q = corner(to_mesh_, near.index(), c) - p;
    return glm::dot(q, q);
  };
  std::uint32_t nearest = squared_to_corner(0) < squared_to_corner(1) ? 0 : 1;
  if (squared_to_corner(2) < squared_to_corner(nearest)) nearest = 2;
  const Vertex v = to_mesh_.origin(Mesh::halfedge(near, nearest));
  int spokes = 0;
  for (const Halfedge h : halfedges_around(to_mesh_, v)) {
    if (++spokes > kMostBoundSpokes) break;
    if (is_near(Mesh::face(h))) return true;
  }
  return false;
}

void OneSidedBound::find_farthest_vertex(Progress* progress) {
  to_ = &lazy_tree_.get();
  const std::size_t n = mesh_.vertex_count();
  const auto look_at = [&](std::size_t i, BoundOutcome& outcome) {
    const Vertex v(static_cast<std::uint32_t>(i));
    if (mesh_.is_isolated(v)) return;
    // Only vertices farther than the farthest one so far matter.
    const double near = outcome.lower;
    const Face hint = this->hint(v, {});
    if (is_near_hint(mesh_.position(v), hint, near * near)) return;
    query(mesh_.position(v), hint, {.near = near, .allowed = 0.0}, outcome);
  };
  BoundOutcome first;
  for (std::size_t i = 0; i < n; i += n / kProbes + 1)
    look_at(i, first);
  note(first);
  std::vector<BoundOutcome> outcomes(chunk_count(n, kVerticesPerChunk));
  parallel_chunks(n, kVerticesPerChunk, progress, [&](std::size_t chunk, IndexRange range) {
    outcomes[chunk].lower = lower_;
    for (std::size_t i = range.begin; i < range.end; ++i)
      look_at(i, outcomes[chunk]);
  });
  for (const BoundOutcome& outcome : outcomes)
    note(outcome);
  is_near_.assign(n, 1);
  near_distance_ = lower_;
}

/// Returns whether half of the faces, judged by a few of them, are within `allowed` if their
/// corners are within `distance`.
bool OneSidedBound::may_corners_settle(double distance, double allowed) const {
  std::size_t count = 0;
  std::size_t settled = 0;
  for (std::size_t i = 0; i < face_count(); i += face_count() / kProbes + 1) {
    const std::uint32_t f = face(i).index();
    const Triangle t{corner(mesh_, f, 0), corner(mesh_, f, 1), corner(mesh_, f, 2)};
    settled += distance + reach(squared_sides(t)) <= allowed ? 1U : 0U;
    ++count;
  }
  return 2 * settled >= count;
}

void OneSidedBound::find_near_vertices(double distance, double allowed, Progress* progress) {
  near_distance_ = distance;
  const std::size_t n = mesh_.vertex_count();
  is_near_.assign(n, 0);
  if (!may_corners_settle(distance, allowed)) return;
  Array<bool> is_needed;
  if (only_) {
    is_needed.assign(n, false);
    for (const Face f : *only_) {
      for (std::uint32_t c = 0; c < 3; ++c)
        is_needed[mesh_.origin(Mesh::halfedge(f, c)).index()] = true;
    }
  }
  parallel_chunks(n, kVerticesPerChunk, progress, [&](std::size_t, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Vertex v(static_cast<std::uint32_t>(i));
      if (mesh_.is_isolated(v) || (only_ && !is_needed[i])) continue;
      const bool is_near = is_near_hint(mesh_.position(v), hint(v, {}), distance * distance);
      is_near_[i] = is_near ? 1 : 0;
    }
  });
}

void OneSidedBound::skim_faces(const BoundLimits& limits, Progress* progress) {
  const SkimInput input{.from = mesh_,
                        .to = to_mesh_,
                        .hints = hints_,
                        .only = only_,
                        .is_near = is_near_,
                        .near = near_distance_,
                        .rounding = rounding_};
  Skimmed skimmed = skim(input, limits.allowed, progress);
  upper_ = std::max(upper_, skimmed.upper);
  unclear_ = std::move(skimmed.unclear);
}

void OneSidedBound::measure_vertices(const BoundLimits& limits, Progress* progress) {
  if (unclear_ && unclear_->empty()) return;
  to_ = &lazy_tree_.get();
  const std::size_t n = mesh_.vertex_count();
  distance_.resize(n);
  near_.resize(n);
  Array<bool> is_needed;
  if (unclear_) {
    is_needed.assign(n, false);
    for (const auto& [face, upper, part] : *unclear_) {
      if (part) continue;  // `begin_faces` measures its corners
      for (std::uint32_t c = 0; c < 3; ++c)
        is_needed[mesh_.origin(Mesh::halfedge(face, c)).index()] = true;
    }
  }
  std::vector<BoundOutcome> outcomes(chunk_count(n, kVerticesPerChunk));
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
  for (const BoundOutcome& outcome : outcomes)
    note(outcome);
}

/// Returns a part of a face, and measures its corners.
BoundPiece OneSidedBound::piece_of(Face face, const Triangle& part, const BoundLimits& limits,
                                   BoundOutcome& outcome) const {
  BoundPiece piece;
  piece.face = face;
  piece.corners = part;
  Face near = hints_[face.index()];
  for (std::size_t c = 0; c < 3; ++c) {
    const TriangleTree::Nearest hit = query(part[c], near, limits, outcome, rounding_);
    piece.distance[c] = hit.squared_distance;
    piece.near[c] = near = hit.face;
  }
  return piece;
}

BoundPiece OneSidedBound::piece_of(Face face) const {
  BoundPiece piece;
  piece.face = face;
  for (std::uint32_t c = 0; c < 3; ++c) {
    const std::uint32_t v = mesh_.origin(Mesh::halfedge(face, c)).index();
    piece.corners[c] = corner(mesh_, face.index(), c);
    piece.distance[c] = distance_[v];
    piece.near[c] = near_[v];
  }
  return piece;
}

/// Returns the least, over the triangles near the piece, of the largest corner distance to that
/// triangle; at most `least`.
double OneSidedBound::bound_by_triangles(const BoundPiece& piece, double least) const {
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

/// Returns a computed bound plus an allowance for rounding. The allowance is 0 if both triangles
/// are identical.
double OneSidedBound::certified(const BoundPiece& piece, double computed) const {
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

/// Returns an upper bound for all points of a piece; not the tightest if a simpler one suffices.
double OneSidedBound::bound(const BoundPiece& piece, const Sides& sides, double allowed) const {
  const double farthest = std::max({piece.distance[0], piece.distance[1], piece.distance[2]});
  const double by_corners = farthest + reach(sides);
  const double simple = certified(piece, by_corners);
  if (simple <= allowed) return simple;
  return certified(piece, bound_by_triangles(piece, by_corners));
}

/// Splits a piece and its parts until all are settled or the splits are used up.
void OneSidedBound::split_up(const BoundPiece& whole, int splits, const BoundLimits& limits,
                             BoundOutcome& outcome) const {
  std::array<BoundPiece, kSplitsOfPiece + 1> stack;
  stack[0] = whole;
  for (std::size_t size = 1; size > 0;) {
    BoundPiece& piece = stack[size - 1];
    const Sides sides = squared_sides(piece.corners);
    piece.upper = bound(piece, sides, limits.allowed);
    const double farthest = std::max({piece.distance[0], piece.distance[1], piece.distance[2]});
    const double longest_side = std::sqrt(std::max({sides[0], sides[1], sides[2]}));
    // Cut flat pieces: halving them would follow the sides of the triangles below down to the
    // allowed distance. Cutting along these sides gives parts over one triangle each, which are
    // bounded exactly. The number of cuts is limited, because they produce slivers.
    const bool is_cut = piece.upper > limits.allowed && piece.cuts < kMostCuts &&
                        farthest < limits.allowed && longest_side > kFlat * limits.allowed;
    // The triangle below the middle gives an exact bound if it covers the whole piece. (The two may
    // be identical, and the distance mere rounding.)
    const bool is_unclear = piece.upper > limits.allowed || piece.upper <= 2.0 * rounding_;
    if (is_cut || (is_unclear && piece.upper > 0.0 && !piece.below.is_valid())) {
      const glm::dvec3 middle = (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0;
      piece.below = query(middle, piece.near[0], limits, outcome, rounding_).face;
      piece.upper = std::min(piece.upper, bound(piece, sides, limits.allowed));
    }
    // Smaller pieces cannot be distinguished.
    if (piece.upper <= limits.allowed || longest_side <= rounding_) {
      outcome.upper = std::max(outcome.upper, piece.upper);
      if (piece.upper > limits.beyond) outcome.beyond.push_back(piece);
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
    BoundPiece& other = stack[size++];
    other = piece;
    for (const auto& [half, end] : {std::pair(&piece, from), std::pair(&other, to)}) {
      half->corners[end] = p;
      half->distance[end] = hit.squared_distance;
      half->near[end] = hit.face;
    }
  }
}

void OneSidedBound::refine(const BoundLimits& limits, Progress* progress) {
  if (!is_begun_) return begin_faces(limits, progress);
  const auto count = static_cast<std::ptrdiff_t>(std::min(open_.size(), kPiecesPerWave));
  // Take the oldest pieces first, so that all are processed if the work is limited; take the newest
  // first if there are too many to store.
  const auto first = open_.size() < kMostOpen ? open_.begin() : open_.end() - count;
  const std::vector<BoundPiece> wave(first, first + count);
  open_.erase(first, first + count);
  std::vector<BoundOutcome> outcomes(chunk_count(wave.size(), kPiecesPerChunk));
  parallel_chunks(wave.size(), kPiecesPerChunk, progress, [&](std::size_t chunk, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      split_up(wave[i], kSplitsOfPiece, limits, outcomes[chunk]);
  });
  for (const BoundOutcome& outcome : outcomes)
    note(outcome);
}

void OneSidedBound::begin_faces(const BoundLimits& limits, Progress* progress) {
  is_begun_ = true;
  const std::size_t n = unclear_ ? unclear_->size() : mesh_.face_count();
  std::vector<BoundOutcome> outcomes(chunk_count(n, kFacesPerChunk));
  parallel_chunks(n, kFacesPerChunk, progress, [&](std::size_t chunk, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      // The allowed distance may have grown since the face was skimmed.
      const Skimmed::Unclear face =
          unclear_ ? (*unclear_)[i] : Skimmed::Unclear{Face(static_cast<std::uint32_t>(i))};
      if (face.upper <= limits.allowed) {
        outcomes[chunk].upper = std::max(outcomes[chunk].upper, face.upper);
      } else {
        const BoundPiece piece = face.part
                                     ? piece_of(face.face, *face.part, limits, outcomes[chunk])
                                     : piece_of(face.face);
        split_up(piece, kSplitsOfFace, limits, outcomes[chunk]);
      }
    }
  });
  for (const BoundOutcome& outcome : outcomes)
    note(outcome);
}

double OneSidedBound::upper() const {
  if (!is_begun_) return std::numeric_limits<double>::infinity();
  double most = std::max(lower_, upper_);
  for (const std::vector<BoundPiece>* pieces : {&open_, &beyond_}) {
    for (const BoundPiece& piece : *pieces)
      most = std::max(most, piece.upper);
  }
  return most;
}

}  // namespace mesher::analysis
