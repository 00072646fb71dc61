// The part of Rounds that looks for new intersections in the result and repeats the work with the
// guard there.
#include <algorithm>

#include "engine/mesh/circulators.h"
#include "engine/simplify/new_intersections.h"
#include "engine/simplify/rounds.h"
#include "engine/simplify/trace.h"

namespace mesher::simplify {
namespace {

// The guard also watches the neighbors of the vertices that made faces intersect, in this many
// rings. They collapse next if those vertices must not.
constexpr std::uint32_t kGuardedRings = 1;
// The region of guarded vertices includes at most so many rings around them.
constexpr std::uint32_t kMostRings = 3;
// Repeating the last region alone saves time if it has less than one in so many vertices.
constexpr std::size_t kShareOfLateWork = 2;
// The guard watches all vertices after this many repetitions, or if it would leave out less than
// one in so many.
constexpr int kMostRepetitions = 6;
constexpr std::size_t kShareOfUnguarded = 4;
// If it watches all, more vertices than this are cut into regions that keep to their territories.
// With fewer, one region is as fast and postpones nothing.
constexpr std::size_t kMostInOneRegion = 16'384;

/// Adds so many rings of neighbors to vertices. `is_inside`: of each vertex, whether it is one of
/// them.
void add_rings(const Mesh& mesh, std::uint32_t rings, std::vector<Vertex>& vertices,
               Array<bool>& is_inside) {
  for (std::size_t i = 0; rings > 0; --rings) {
    for (const std::size_t end = vertices.size(); i < end; ++i) {
      for (const Halfedge h : halfedges_around(mesh, vertices[i])) {
        for (const Vertex neighbor : {mesh.target(h), mesh.origin(Mesh::prev(h))}) {
          if (is_inside[neighbor.index()]) continue;
          is_inside[neighbor.index()] = true;
          vertices.push_back(neighbor);
        }
      }
    }
  }
}

bool is_guarded(const Surface& surface, const analysis::FacePair& pair) {
  const Mesh& mesh = surface.mesh();
  return std::ranges::any_of(pair, [&](Face f) {
    return std::ranges::any_of(std::array{0U, 1U, 2U}, [&](std::uint32_t c) {
      return surface.state(mesh.origin(Mesh::halfedge(f, c))).is_guarded;
    });
  });
}

}  // namespace

/// Collapses such that no two faces of the result intersect that did not before. Few places need a
/// guard. They are found afterwards, which takes less time than to check each collapse.
void Rounds::run_without_intersections() {
  Saved start = save();
  untold_.emplace();
  run_rounds();
  std::optional<Saved> before_end;
  if (live_.size() * kShareOfLateWork < start.live.size()) before_end = save();
  run_to_the_end();
  auto pairs = find_pairs(start, surface_);
  if (!pairs.empty() && before_end) {
    guard_from(start, surface_, pairs);
    pairs = repeat_the_end(start, *before_end, pairs);
  }
  // The last repetition checks all collapses.
  for (int repetitions = 1; !pairs.empty() && repetitions <= kMostRepetitions; ++repetitions) {
    guard_from(start, surface_, pairs);
    restore(start);
    const auto unguarded = static_cast<std::size_t>(
        std::ranges::count_if(live_, [&](Vertex v) { return !surface_.state(v).is_guarded; }));
    if (repetitions == kMostRepetitions || unguarded * kShareOfUnguarded < live_.size()) {
      if (live_.size() > kMostInOneRegion) guarding_ = Guarding::everywhere;
      guard_all();
    }
    run_rounds();
    run_to_the_end();
    pairs = find_pairs(start, surface_);
  }
  tell(*std::exchange(untold_, std::nullopt));
}

/// Returns the pairs of faces that did not intersect at the start.
std::vector<analysis::FacePair> Rounds::find_pairs(const Saved& start,
                                                   const Surface& surface) const {
  return new_intersections(start.surface.mesh(), surface.mesh(), options_.progress);
}

/// Repeats the last region with the guard where it made the pairs intersect. Returns the pairs of
/// the new result. If faces intersect there before, it guards their origins at the start, and
/// returns the pairs unchanged.
std::vector<analysis::FacePair> Rounds::repeat_the_end(Saved& start, Saved& before_end,
                                                       std::vector<analysis::FacePair> pairs) {
  guard_from(before_end, surface_, pairs);
  const auto early = find_pairs(start, before_end.surface);
  const bool is_too_late = std::ranges::any_of(
      early, [&](const analysis::FacePair& pair) { return is_guarded(before_end.surface, pair); });
  if (is_too_late) {
    guard_from(start, before_end.surface, early);
    return pairs;
  }
  restore(before_end);
  run_to_the_end();
  return find_pairs(start, surface_);
}

Rounds::Saved Rounds::save() const {
  return {.surface = surface_,
          .attributes = policy_->attributes() != nullptr ? policy_->attributes()->save()
                                                         : AttributeField::Saved{},
          .bound = bound_ != nullptr ? bound_->save() : ErrorBound::Saved{},
          .tracked = tracked_,
          .live = live_,
          .untold = untold_ ? untold_->size() : 0,
          .steps = steps_.size(),
          .faces = faces_,
          .collapses = collapses_,
          .paid = paid_,
          .rejected = rejected_,
          .meets_bound = meets_bound_,
          .has_postponed = has_postponed_,
          .removed_faces = context_.removed_faces};
}

void Rounds::restore(const Saved& saved) {
  surface_ = saved.surface;
  if (policy_->attributes() != nullptr) policy_->attributes()->restore(saved.attributes);
  if (bound_ != nullptr) bound_->restore(saved.bound);
  tracked_ = saved.tracked;
  context_.samples = tracked_ ? &*tracked_ : nullptr;
  live_ = saved.live;
  untold_->resize(saved.untold);
  steps_.resize(saved.steps);
  faces_ = saved.faces;
  collapses_ = saved.collapses;
  paid_ = saved.paid;
  rejected_ = saved.rejected;
  meets_bound_ = saved.meets_bound;
  has_postponed_ = saved.has_postponed;
  context_.removed_faces = saved.removed_faces;
  error_at_stop_.reset();
  held_.reset();
}

/// Guards the vertices of an earlier state that are merged into corners of pairs in a later one.
void Rounds::guard_from(Saved& saved, const Surface& later,
                        std::span<const analysis::FacePair> pairs) {
  const Mesh& mesh = later.mesh();
  const Array<std::uint32_t> survivor = find_survivors(later);
  Array<bool> is_corner;
  is_corner.assign(mesh.vertex_count(), false);
  for (const analysis::FacePair& pair : pairs) {
    for (const Face f : pair) {
      for (std::uint32_t c = 0; c < 3; ++c)
        is_corner[survivor[mesh.origin(Mesh::halfedge(f, c)).index()]] = true;
    }
  }
  Array<bool> is_origin;
  is_origin.assign(mesh.vertex_count(), false);
  std::vector<Vertex> origins;
  for (const Vertex v : saved.live) {
    if (!is_corner[survivor[v.index()]]) continue;
    is_origin[v.index()] = true;
    origins.push_back(v);
  }
  add_rings(saved.surface.mesh(), kGuardedRings, origins, is_origin);
  for (const Vertex v : origins)
    saved.surface.state(v).is_guarded = true;
  make_space();
}

/// Moves the guarded vertices to the end of `live_`, and returns their number. They become a region
/// of their own, so that its guard sees all of them. Some unguarded rings around join them,
/// another number in each round, so that edges at the border of that region get their turn.
std::size_t Rounds::move_guarded_last(std::uint32_t round) {
  if (space_ == nullptr) return 0;
  const Mesh& mesh = surface_.mesh();
  Array<bool> is_inside;
  is_inside.assign(mesh.vertex_count(), false);
  std::vector<Vertex> inside;
  for (const Vertex v : live_) {
    if (!surface_.state(v).is_guarded) continue;
    is_inside[v.index()] = true;
    inside.push_back(v);
  }
  add_rings(mesh, 1 + round % kMostRings, inside, is_inside);
  std::stable_partition(live_.begin(), live_.end(),
                        [&](Vertex v) { return !is_inside[v.index()]; });
  return inside.size();
}

void Rounds::guard_all() {
  for (const Vertex v : live_)
    surface_.state(v).is_guarded = true;
  make_space();
}

void Rounds::make_space() {
  if (space_ == nullptr) space_ = std::make_unique<GuardedSpace>(surface_.mesh().face_count());
  context_.space = space_.get();
}

}  // namespace mesher::simplify
