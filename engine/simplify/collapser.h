#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/simplify/appraisal.h"
#include "engine/simplify/bucket_queue.h"
#include "engine/simplify/cost_policy.h"
#include "engine/simplify/error_bound.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/intersection_guard.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/report.h"
#include "engine/simplify/surface.h"
#include "engine/simplify/tracked_samples.h"

namespace mesher {

/// What stays the same over a whole simplification.
struct CollapseContext {
  Surface& surface;
  CollapsePolicy& policy;
  std::span<QueueEntry> queue;  ///< by vertex
  ErrorBound* bound = nullptr;
  TrackedSamples* samples = nullptr;  ///< where one region is left and costs are measured
  GuardedSpace* space = nullptr;      ///< none where faces may come to intersect
  /// With it: no collapse gets a lower rank. Each then also comes after those before it in its
  /// region, and after all of earlier rounds, since what is far on the surface may be near in
  /// space.
  std::uint16_t least_rank = 0;
  CostPrecision precision =
      CostPrecision::exact;  ///< with which edges are looked at before their turn
  Progress* progress = nullptr;
  std::uint32_t faces_to_remove = 0;            ///< in all
  std::atomic<std::uint32_t> removed_faces{0};  ///< so far, for the progress
};

/// The cheapest of the edges that it is offered, of equals that of the lowest index. Which is
/// cheaper cannot be guessed, so there is no branch: one number holds the cost's bits, which for
/// costs that are not negative (-0 is) are in the order of the costs, above the half-edge's.
class Cheapest {
 public:
  Cheapest() = default;
  Cheapest(Halfedge h, float cost) : least_(key(h, cost)) {}

  void offer(Halfedge h, float cost) { least_ = std::min(least_, key(h, cost)); }

  /// None, or an edge that must not be merged, where the cost is kNever.
  Halfedge halfedge() const { return Halfedge(static_cast<std::uint32_t>(least_)); }
  float cost() const { return std::bit_cast<float>(static_cast<std::uint32_t>(least_ >> 32U)); }

 private:
  static std::uint64_t key(Halfedge h, float cost) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << 32U | h.index();
  }

  std::uint64_t least_ = key(Halfedge(), kNever);
};

/// What came of the work on one region.
struct CollapseOutcome {
  std::uint32_t removed_faces = 0;
  double paid = 0.0;  ///< sum of Candidate::error
  Array<CollapseRecord> records;
  std::array<std::uint64_t, kRejectionCount> rejected{};
};

/// Gives every edge its first cost, and every vertex its cheapest edge. Pre: they have none yet.
/// O(F), parallel. Throws Cancelled.
///
/// From then on a cost may be out of date: a collapse evaluates the edges of its own vertex, not
/// those of the neighbors. An edge is looked at again when its turn comes (costs mostly rise, so
/// that nothing cheap is missed).
void evaluate_all(const CollapseContext& context);

/// Collapses edges of one region (a set of vertices), cheapest first. Regions may be worked on at
/// once: a collapse is done only where both ends and their whole one-rings are of the region, and
/// touches nothing but them and the faces that they have; what belongs to a vertex of the region
/// can only be changed by it. Other edges wait for a round in which the regions are cut
/// differently.
class Collapser {
 public:
  struct Limits {
    std::uint32_t region = 0;
    float cost = kNever;          ///< nothing dearer is collapsed
    std::uint32_t tolerance = 0;  ///< buckets that an edge may be dearer than was thought
    /// At most so many are removed, or one more: a collapse inside the surface removes two. Where
    /// one is left to remove, a legal collapse at the boundary is preferred, unless it is far
    /// dearer.
    std::uint32_t faces = 0;
    /// After so many the edges of a collapse's neighbors are evaluated again, too.
    std::uint32_t fresh_after = kNone;
    std::size_t valence = 0;  ///< no vertex of more faces is made
  };

  Collapser(CollapseContext& context, const Limits& limits);

  /// Works until nothing within the limits is left. Throws Cancelled. Call once.
  [[nodiscard]] CollapseOutcome run(std::span<const Vertex> vertices);
  /// The same, after all refused edges have been given a cost again.
  [[nodiscard]] CollapseOutcome run_refused(std::span<const Vertex> vertices);

 private:
  /// What the neighbors of an edge say of a collapse.
  struct RingSurvey {
    bool has_refused = false;  ///< one has a refused edge
    std::uint16_t rank = 0;    ///< the highest
  };

  VertexState& state(Vertex v) { return context_.surface.state(v); }
  bool is_ours(Vertex v) const { return context_.surface.state(v).region == limits_.region; }
  void fill_queue(std::span<const Vertex> vertices);
  void empty_queue(std::span<const Vertex> vertices);
  void process_queue();
  void look_ahead(Vertex v);
  void collapse_or_requeue(Vertex v);
  bool remove_one_face(std::span<const Vertex> vertices, float most);
  Candidate evaluate(Halfedge h);
  void choose_cheapest_edge(Vertex v);
  void enqueue(Vertex v, const Cheapest& cheapest);
  void evaluate_fan(Vertex v);
  void evaluate_refused(Vertex v);
  void refuse(Halfedge h, Rejection cause);
  std::optional<Rejection> check(Halfedge h, const Candidate& candidate);
  std::optional<Rejection> check_intersections(Halfedge h, const glm::vec3& p);
  Appraisal appraise(Halfedge h, const Candidate& candidate);
  void collapse(Halfedge h, const Candidate& candidate, const Appraisal& appraisal);
  std::uint16_t take_rank(Halfedge h, float cost);
  bool is_ring_ours() const;
  void survey_ring();
  bool makes_feature_triangle(Halfedge h) const;
  void add_contributions(Face f, float sign);
  void merge(Halfedge h, const glm::vec3& p);
  void merge_near_feature(Halfedge h, const glm::vec3& p);
  void merge_smooth(Halfedge h, const glm::vec3& p);
  void retry_refused_in_ring();
  void refresh_ring(Vertex kept);

  CollapseContext& context_;
  Limits limits_;
  BucketQueue queue_;
  Fan fan_;
  std::vector<float> costs_;     ///< scratch of evaluate_fan and refresh_ring
  std::vector<Halfedge> stale_;  ///< scratch of refresh_ring
  RingSurvey ring_;              ///< of the fan, from a check that got so far to its collapse
  std::optional<IntersectionGuard> guard_;
  std::uint16_t least_rank_;
  CollapseOutcome outcome_;
};

}  // namespace mesher
