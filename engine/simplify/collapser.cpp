#include "engine/simplify/collapser.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/mesh/circulators.h"

namespace mesher::simplify {

static_assert(CollapseRecord::kRanks == BucketQueue::kBuckets);

namespace {

// Highest cost for removing a single face, relative to the next collapse, which removes two: four
// times the distance.
constexpr float kMostForOneFace = 16.0F;
// Maximum number of edges re-evaluated at a vertex, so that hubs stay cheap.
constexpr std::size_t kFreshSpokes = 64;

/// Returns whether merging the edge would close a loop of three features. Seams count, unless the
/// edge is merged across them.
bool is_in_feature_loop(const Surface& surface, Halfedge h) {
  if (!surface.is_in_loop(h, EdgeKind::seam)) return false;
  return surface.allowed_placement(h) != AllowedPlacement::across ||
         surface.is_in_loop(h, EdgeKind::feature);
}

/// Calls `visit` for the half-edges out of `v`, at most `limit` of them.
template <class Visit>
void visit_spokes(const Mesh& mesh, Vertex v, std::size_t limit, const Visit& visit) {
  Circulator at(mesh, mesh.outgoing(v));
  do {
    visit(*at);
  } while (--limit > 0 && at.advance());
}

/// Computes the first costs of the edges owned by a range of vertices.
class FirstCosts {
 public:
  explicit FirstCosts(const CollapseContext& context) : context_(context) {}

  void find(IndexRange vertices) {
    const Mesh& mesh = context_.surface.mesh();
    std::size_t count = 0;
    for (std::size_t i = vertices.begin; i < vertices.end; ++i) {
      const Vertex v(static_cast<std::uint32_t>(i));
      if (mesh.is_isolated(v)) continue;
      visit_spokes(mesh, v, kNone, [&](Halfedge h) {
        if (count == edges_.size()) edges_.resize(2 * count + 64);
        edges_[count] = h;
        // An invalid twin has the highest index, so the origin of a boundary edge owns it.
        // Branch-free, because which half is the lower one is unpredictable.
        count += static_cast<std::size_t>(h < mesh.twin(h));
      });
    }
    costs_.resize(count);
    context_.policy.evaluate_costs(context_.surface, std::span(edges_).first(count),
                                   context_.precision, costs_.data());
    for (std::size_t i = 0; i < count; ++i)
      note(edges_[i], costs_[i]);
  }

 private:
  void note(Halfedge h, float cost) {
    Surface& surface = context_.surface;
    surface.set_cost(h, cost);
    VertexState& from = surface.state(surface.mesh().origin(h));
    Cheapest cheapest(from.best, from.cost);
    cheapest.offer(h, cost);
    from.best = cheapest.halfedge();
    from.cost = cheapest.cost();
  }

  const CollapseContext& context_;
  std::vector<Halfedge> edges_;
  std::vector<float> costs_;
};

}  // namespace

void evaluate_all(const CollapseContext& context) {
  constexpr std::size_t kVertices = 2048;
  const std::size_t n = context.surface.mesh().vertex_count();
  parallel_chunks(n, kVertices, context.progress,
                  [&](std::size_t, IndexRange range) { FirstCosts(context).find(range); });
}

Collapser::Collapser(CollapseContext& context, const Limits& limits)
    : context_(context), limits_(limits), queue_(context.queue), least_rank_(context.least_rank) {}

CollapseOutcome Collapser::run(std::span<const Vertex> vertices) {
  outcome_.records.reserve(std::min<std::size_t>(vertices.size(), limits_.faces / 2 + 1));
  const bool is_any_guarded =
      std::ranges::any_of(vertices, [&](Vertex v) { return context_.surface.state(v).is_guarded; });
  if (is_any_guarded) {
    guard_.emplace(context_.surface, *context_.space, limits_.region, vertices);
  }
  fill_queue(vertices);
  process_queue();
  const Vertex next = queue_.front();
  const bool compares = next.is_valid() && context_.policy.costs_are_errors();
  const float most = compares ? kMostForOneFace * state(next).cost : kNever;
  empty_queue(vertices);
  if (outcome_.removed_faces + 1 == limits_.faces) {
    if (!remove_one_face(vertices, most)) {
      ++limits_.faces;  // no boundary edge is suitable: remove two faces or none
      fill_queue(vertices);
      process_queue();
    }
    empty_queue(vertices);
  }
  return std::move(outcome_);
}

CollapseOutcome Collapser::run_refused(std::span<const Vertex> vertices) {
  for (const Vertex v : vertices) {
    evaluate_refused(v);
    choose_cheapest_edge(v);
    queue_.remove(v);
  }
  return run(vertices);
}

void Collapser::fill_queue(std::span<const Vertex> vertices) {
  for (const Vertex v : vertices) {
    const VertexState& s = state(v);
    if (s.region == VertexState::kGone) continue;
    if (s.cost <= limits_.cost && s.cost < kNever) queue_.push(v, s.cost);
  }
}

void Collapser::empty_queue(std::span<const Vertex> vertices) {
  for (const Vertex v : vertices)
    queue_.remove(v);
}

void Collapser::process_queue() {
  constexpr std::uint32_t kStepsBetweenReports = 1024;
  std::uint32_t reported = outcome_.removed_faces;
  const auto note_progress = [&] {
    const std::uint32_t all = context_.removed_faces += outcome_.removed_faces - reported;
    reported = outcome_.removed_faces;
    report(context_.progress,
           static_cast<float>(all) / static_cast<float>(context_.faces_to_remove));
  };
  for (std::uint32_t step = 1; outcome_.removed_faces + 1 < limits_.faces; ++step) {
    const Vertex v = queue_.front();
    if (!v.is_valid()) break;
    look_ahead(v);
    collapse_or_requeue(v);
    if (step % kStepsBetweenReports == 0) note_progress();
  }
  note_progress();
}

/// Prefetches what the next three queue entries will probably read, one step ahead each: the state
/// of the third vertex, the edge of the second, and the surroundings of the next edge's face.
void Collapser::look_ahead(Vertex v) {
  const Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  const Vertex next = queue_.behind(v);
  if (!next.is_valid()) return;
  const Halfedge h = surface.state(next).best;
  // The edge may have been removed by now.
  if (const Vertex target = mesh.target(h); target.is_valid()) surface.will_need(target);
  for (const Halfedge side : {h, Mesh::prev(h), Mesh::next(h)}) {
    if (const Halfedge t = mesh.twin(side); t.is_valid()) surface.will_need(t);
  }
  context_.policy.will_need(mesh, h);
  const Vertex second = queue_.behind(next);
  if (!second.is_valid()) return;
  surface.will_need(surface.state(second).best);
  context_.policy.will_need_later(surface.state(second).best);
  if (const Vertex third = queue_.behind(second); third.is_valid()) surface.will_need(third);
}

/// Collapses the vertex's cheapest edge, or puts the vertex back into the queue at its current
/// cost.
void Collapser::collapse_or_requeue(Vertex v) {
  Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  const std::uint32_t bucket = queue_.bucket(v);
  queue_.remove(v);
  const Halfedge h = state(v).best;
  // The edge may be removed, more expensive, or owned by another vertex by now.
  if (mesh.origin(h) != v || BucketQueue::bucket_of(surface.cost(h)) > bucket) {
    return choose_cheapest_edge(v);
  }
  // The edge crosses the region's border: leave it to a later round.
  if (!is_ours(mesh.target(h))) return;
  const Candidate candidate = evaluate(h);
  surface.set_cost(h, candidate.cost);
  if (BucketQueue::bucket_of(candidate.cost) > bucket + limits_.tolerance) {
    return choose_cheapest_edge(v);
  }
  std::optional<Rejection> cause = check(h, candidate);
  if (!cause) return;
  if (*cause == Fan::kLegal) {
    const Appraisal appraisal = appraise(h, candidate);
    if (BucketQueue::bucket_of(appraisal.cost) > bucket + limits_.tolerance) {
      // Requeue at the full cost.
      surface.set_cost(h, appraisal.cost);
      return choose_cheapest_edge(v);
    }
    // Last, because it takes longest.
    cause = check_intersections(h, candidate.position);
    if (!cause) return;
    if (*cause == Fan::kLegal) return collapse(h, candidate, appraisal);
  }
  refuse(h, *cause);
  choose_cheapest_edge(v);
}

/// Pre: `check` returned kLegal for this collapse.
Appraisal Collapser::appraise(Halfedge h, const Candidate& candidate) {
  if (!context_.policy.costs_are_errors()) return {candidate.cost, 0.0F, candidate.cost};
  Appraisal appraisal = simplify::appraise(context_.surface, h, fan_, candidate);
  if (context_.samples != nullptr) {
    appraisal.cost += context_.samples->correction(context_.surface, h, fan_, candidate.position,
                                                   appraisal.left_behind);
  }
  return appraisal;
}

/// Removes one face: does the cheapest legal boundary collapse that costs at most `most`. Returns
/// false if there is none.
bool Collapser::remove_one_face(std::span<const Vertex> vertices, float most) {
  const Mesh& mesh = context_.surface.mesh();
  std::vector<std::pair<float, Halfedge>> edges;
  for (const Vertex v : vertices) {
    if (!is_ours(v) || !mesh.is_boundary(v)) continue;
    const Halfedge h = mesh.outgoing(v);
    if (!is_ours(mesh.target(h))) continue;
    const float cost = evaluate(h).cost;
    if (cost <= limits_.cost && cost < kNever) edges.emplace_back(cost, h);
  }
  std::sort(edges.begin(), edges.end());
  for (const auto& [cost, h] : edges) {
    const Candidate candidate = evaluate(h);
    if (check(h, candidate) != Fan::kLegal) continue;
    const Appraisal appraisal = appraise(h, candidate);
    if (!(appraisal.cost <= most)) continue;
    if (check_intersections(h, candidate.position) != Fan::kLegal) continue;
    collapse(h, candidate, appraisal);
    return true;
  }
  return false;
}

Candidate Collapser::evaluate(Halfedge h) {
  const AllowedPlacement allowed = context_.surface.allowed_placement(h);
  if (allowed == AllowedPlacement::nowhere) return {};
  return context_.policy.evaluate(context_.surface, h, allowed);
}

void Collapser::choose_cheapest_edge(Vertex v) {
  const Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  Cheapest cheapest;
  visit_spokes(mesh, v, limits_.valence, [&](Halfedge h) { cheapest.offer(h, surface.cost(h)); });
  enqueue(v, cheapest);
}

/// Sets a vertex's cheapest edge and inserts the vertex into the queue.
void Collapser::enqueue(Vertex v, const Cheapest& cheapest) {
  const float cost = cheapest.cost();
  state(v).best = cheapest.halfedge();
  state(v).cost = cost;
  if (cost <= limits_.cost && cost < kNever) queue_.push(v, cost);
}

/// Evaluates every edge of the fan's vertex and inserts the vertex into the queue.
void Collapser::evaluate_fan(Vertex v) {
  Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  costs_.resize(fan_.size() + 8);
  context_.policy.evaluate_around(context_.surface, v, fan_, context_.precision, costs_.data());
  Cheapest cheapest;
  for (std::size_t i = 0; i < fan_.size(); ++i) {
    const Halfedge h = fan_.spokes()[i];
    surface.set_cost(h, costs_[i]);
    // The other half of the next spoke's edge.
    surface.set_cost(Mesh::prev(h), kNever);
    cheapest.offer(h, costs_[i]);
  }
  enqueue(v, cheapest);
  if (fan_.is_closed() || fan_.size() == 0) return;
  // The last edge of an open fan has no half-edge out of the vertex, so the neighbor owns it.
  const Halfedge last = Mesh::prev(fan_.spokes().back());
  const Vertex neighbor = mesh.origin(last);
  surface.set_cost(last, costs_[fan_.size()]);
  queue_.remove(neighbor);
  choose_cheapest_edge(neighbor);
}

/// Re-evaluates the refused edges at `v`, which owns them from then on.
void Collapser::evaluate_refused(Vertex v) {
  Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  visit_spokes(mesh, v, limits_.valence, [&](Halfedge h) {
    const Halfedge t = mesh.twin(h);
    const bool is_refused =
        surface.cost(h) == kNever && (!t.is_valid() || surface.cost(t) == kNever);
    if (is_refused && is_ours(mesh.target(h))) surface.set_cost(h, evaluate(h).cost);
  });
}

void Collapser::refuse(Halfedge h, Rejection cause) {
  Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  if (surface.note_refused(h)) ++outcome_.rejected[static_cast<std::size_t>(cause)];
  outcome_.meets_bound |= cause == Rejection::error_bound;
  surface.set_cost(h, kNever);
  // A collapse nearby rarely removes an intersection, and checking for it again takes long.
  const bool is_fresh = outcome_.removed_faces > limits_.fresh_after;
  if (cause == Rejection::intersection && !is_fresh) {
    outcome_.has_postponed = true;
    return;
  }
  for (const Vertex v : {mesh.origin(h), mesh.target(h)})
    state(v).has_refused = true;
}

/// Returns why a collapse is not allowed for other reasons than new intersections, or Fan::kLegal;
/// returns nothing if the ring crosses the region's border. Leaves the fan gathered.
std::optional<Rejection> Collapser::check(Halfedge h, const Candidate& candidate) {
  const Surface& surface = context_.surface;
  const bool is_whole = fan_.gather(surface, h, limits_.valence);
  if (!is_ring_ours()) return std::nullopt;
  survey_ring();
  if (!is_whole) {
    outcome_.has_postponed = true;
    return Rejection::link_condition;
  }
  context_.policy.will_need(fan_);
  // Coordinates near the limits of float may have overflowed.
  const glm::vec3& p = candidate.position;
  if (!std::isfinite(p.x + p.y + p.z)) return Rejection::fold_over;
  Rejection cause = fan_.check_topology(surface);
  // A loop of three features must not close.
  if (cause == Fan::kLegal && !fan_.is_smooth() && is_in_feature_loop(surface, h)) {
    cause = Rejection::crease;
  }
  if (cause == Fan::kLegal) cause = fan_.check_shape(surface, candidate.position);
  if (cause == Fan::kLegal && fan_.turned_area() > 0.0F && !context_.policy.costs_are_errors()) {
    cause = Rejection::fold_over;
  }
  if (cause == Fan::kLegal && !context_.policy.allows(surface, h, fan_, candidate.position)) {
    cause = Rejection::fold_over;
  }
  if (cause == Fan::kLegal && context_.bound != nullptr) {
    estimate_ = context_.bound->estimate(surface, h, fan_, p);
    if (!context_.bound->allows(surface, h, fan_, p, estimate_)) cause = Rejection::error_bound;
  }
  return cause;
}

/// Same, for new intersections. Pre: `check` returned kLegal for this collapse.
std::optional<Rejection> Collapser::check_intersections(Halfedge h, const glm::vec3& p) {
  if (!guard_ || !is_near_guarded(h)) return Fan::kLegal;
  const Mesh& mesh = context_.surface.mesh();
  switch (guard_->check(context_.surface, fan_, mesh.origin(h), mesh.target(h), p)) {
    case IntersectionGuard::Verdict::legal:
      return Fan::kLegal;
    case IntersectionGuard::Verdict::intersects:
      return Rejection::intersection;
    case IntersectionGuard::Verdict::outside_territory:
      break;
  }
  return std::nullopt;
}

/// Separate from survey_ring, because of other regions' vertices only `region` may be read.
bool Collapser::is_ring_ours() const {
  bool is_ours = true;
  for (const Vertex v : fan_.ring())
    is_ours &= this->is_ours(v);
  return is_ours;
}

/// Returns whether the collapse changes faces with a guarded corner. Pre: the ring is surveyed.
bool Collapser::is_near_guarded(Halfedge h) const {
  const Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  return ring_.is_guarded || surface.state(mesh.origin(h)).is_guarded ||
         surface.state(mesh.target(h)).is_guarded;
}

/// Gathers the properties of the neighbors in one branch-free loop.
void Collapser::survey_ring() {
  ring_ = {};
  for (const Vertex v : fan_.ring()) {
    const VertexState& s = state(v);
    ring_.has_refused |= s.has_refused;
    ring_.is_guarded |= s.is_guarded;
    ring_.rank = std::max<std::uint16_t>(ring_.rank, s.rank);
  }
}

/// Returns the rank of the next collapse.
std::uint16_t Collapser::rank(Halfedge h, float cost) const {
  const Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  const std::uint32_t of_ends =
      std::max(surface.state(mesh.target(h)).rank, surface.state(mesh.origin(h)).rank);
  return static_cast<std::uint16_t>(
      std::max({BucketQueue::bucket_of(cost), of_ends, std::uint32_t{ring_.rank},
                std::uint32_t{least_rank_}}));
}

void Collapser::collapse(Halfedge h, const Candidate& candidate, const Appraisal& appraisal) {
  const Mesh& mesh = context_.surface.mesh();
  const Vertex kept = mesh.target(h);
  const CollapseRecord record{h,    mesh.twin(h),       mesh.origin(h),
                              kept, candidate.position, rank(h, appraisal.cost)};
  apply({record, candidate.error, appraisal.retreat, estimate_, {}});
  evaluate_fan(kept);
  retry_refused_in_ring();
  if (outcome_.removed_faces > limits_.fresh_after) refresh_ring(kept);
}

/// Re-evaluates the edges of the neighbors, whose quadrics the collapse has changed. Those of the
/// merged vertex are up to date.
void Collapser::refresh_ring(Vertex kept) {
  Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  const auto is_in_ring = [&](Vertex v) { return std::ranges::count(fan_.ring(), v) > 0; };
  stale_.clear();
  for (const Vertex v : fan_.ring()) {
    visit_spokes(mesh, v, kFreshSpokes, [&](Halfedge h) {
      if (surface.cost(h) != kNever) stale_.push_back(h);
      const Halfedge t = mesh.twin(h);
      if (!t.is_valid() || surface.cost(t) == kNever) return;
      if (mesh.origin(t) != kept && !is_in_ring(mesh.origin(t))) stale_.push_back(t);
    });
  }
  costs_.resize(stale_.size());
  context_.policy.evaluate_costs(surface, stale_, CostPrecision::exact, costs_.data());
  for (std::size_t i = 0; i < stale_.size(); ++i)
    surface.set_cost(stale_[i], costs_[i]);
  Vertex last;
  for (const Halfedge h : stale_) {
    const Vertex v = mesh.origin(h);
    if (v == last) continue;
    last = v;
    queue_.remove(v);
    choose_cheapest_edge(v);
  }
}

/// Re-evaluates edges that were refused near the collapse: they may be legal now.
void Collapser::retry_refused_in_ring() {
  if (!ring_.has_refused) return;
  for (const Vertex v : fan_.ring()) {
    if (!state(v).has_refused) continue;
    state(v).has_refused = false;
    evaluate_refused(v);
    queue_.remove(v);
    choose_cheapest_edge(v);
  }
}

}  // namespace mesher::simplify
