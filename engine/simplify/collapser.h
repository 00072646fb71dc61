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

namespace mesher::simplify {

/// Data shared by all collapses of a simplification.
struct CollapseContext {
  Surface& surface;
  CollapsePolicy& policy;
  std::span<QueueEntry> queue;  ///< by vertex
  ErrorBound* bound = nullptr;
  TrackedSamples* samples = nullptr;  ///< set once a single region is left and costs are measured
  GuardedSpace* space = nullptr;      ///< null if no vertex is guarded
  /// Lowest rank of new collapses. Used with `space` only: each collapse then also ranks at or
  /// above those before it in its region and all those of earlier rounds, because parts that are
  /// far apart on the surface may be close in space.
  std::uint16_t least_rank = 0;
  /// Of costs before an edge reaches the front of the queue.
  CostPrecision precision = CostPrecision::exact;
  Progress* progress = nullptr;
  std::uint32_t faces_to_remove = 0;            ///< in total
  std::atomic<std::uint32_t> removed_faces{0};  ///< so far, for progress reports
};

/// The cheapest edge offered; ties go to the lowest index. The comparison is unpredictable, so it
/// is branch-free: a 64-bit key holds the bits of the cost above the half-edge's index. The bits of
/// nonnegative floats (without -0) sort like the floats themselves.
class Cheapest {
 public:
  Cheapest() = default;
  Cheapest(Halfedge h, float cost) : least_(key(h, cost)) {}

  void offer(Halfedge h, float cost) { least_ = std::min(least_, key(h, cost)); }

  /// Returns the cheapest edge: none, or an edge of cost kNever that must not be merged, if there
  /// is no mergeable one.
  Halfedge halfedge() const { return Halfedge(static_cast<std::uint32_t>(least_)); }
  float cost() const { return std::bit_cast<float>(static_cast<std::uint32_t>(least_ >> 32U)); }

 private:
  static std::uint64_t key(Halfedge h, float cost) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << 32U | h.index();
  }

  std::uint64_t least_ = key(Halfedge(), kNever);
};

/// Result of collapsing in one region.
struct CollapseOutcome {
  std::uint32_t removed_faces = 0;
  double paid = 0.0;  ///< sum of Candidate::error
  Array<CollapseRecord> records;
  Array<CollapseStep> steps;  ///< the same collapses; only if there is an error bound
  /// Edges by the cause for which they were refused first.
  std::array<std::uint64_t, kRejections.size()> rejected{};
  bool meets_bound = false;  ///< an edge was refused because of the error bound
  /// An edge was refused because too many faces would meet, or because of an intersection that is
  /// not looked for again after each collapse nearby.
  bool has_postponed = false;
};

/// Computes the first cost of every edge and the cheapest edge of every vertex. Pre: no edge has a
/// cost yet. O(F), parallel. Throws Cancelled.
///
/// Costs may become stale later: a collapse re-evaluates the edges of its merged vertex, not those
/// of the neighbors. The collapser re-evaluates an edge when it reaches the front of the queue.
/// Costs mostly rise, so no cheap edge is missed.
void evaluate_all(const CollapseContext& context);

/// Collapses edges of one region (a set of vertices), cheapest first. Regions can run concurrently:
/// a collapse is done only if both ends and their entire one-rings belong to the region, and it
/// writes only those vertices and their faces. Hence only the region itself changes data of its
/// vertices. Other edges are left to a later round with different regions.
class Collapser {
 public:
  struct Limits {
    std::uint32_t region = 0;
    float cost = kNever;  ///< edges of a higher cost are not collapsed
    /// Number of buckets by which an edge may exceed its expected cost
    std::uint32_t tolerance = 0;
    /// Maximum number of faces to remove; one more is possible, because an interior collapse
    /// removes two. If exactly one is left to remove, a legal boundary collapse is preferred unless
    /// it is far more expensive.
    std::uint32_t faces = 0;
    /// Once more faces than this are removed, the edges of the neighbors are re-evaluated after
    /// each collapse, too.
    std::uint32_t fresh_after = kNone;
    std::size_t valence = 0;  ///< maximum number of faces at a vertex after a collapse
  };

  Collapser(CollapseContext& context, const Limits& limits);

  /// Collapses edges until none within the limits is left. Throws Cancelled. Call once.
  [[nodiscard]] CollapseOutcome run(std::span<const Vertex> vertices);
  /// Same, after re-evaluating all refused edges.
  [[nodiscard]] CollapseOutcome run_refused(std::span<const Vertex> vertices);
  /// Repeats the collapses of an earlier run, in their order, except those that the error bound no
  /// longer allows where it is tight, and those whose surroundings differ because of that. If the
  /// earlier run was exhausted, evaluates the edges whose surroundings differ, because the others
  /// would be refused again; otherwise all edges are left to `evaluate_all`. Pre: no edge has a
  /// cost yet, all vertices belong to the region, and intersections are not guarded against.
  /// O(collapses), on one thread a sixth to a third of the time of finding them. Throws Cancelled.
  [[nodiscard]] CollapseOutcome repeat(std::span<const CollapseStep> steps, bool was_exhausted);

 private:
  /// Properties of the neighbors of an edge that matter to a collapse.
  struct RingSurvey {
    bool has_refused = false;  ///< a neighbor has a refused edge
    bool is_guarded = false;   ///< a neighbor is guarded
    std::uint16_t rank = 0;    ///< highest rank of the neighbors
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
  void apply(CollapseStep step);
  void note(const CollapseStep& step);
  void prefetch_ends(const CollapseRecord& record) const;
  bool can_repeat(const CollapseStep& step, const Array<bool>& differs);
  void apply_again(const CollapseStep& step);
  void evaluate_near(const Array<bool>& differs);
  std::uint16_t rank(Halfedge h, float cost) const;
  bool is_ring_ours() const;
  void survey_ring();
  bool is_near_guarded(Halfedge h) const;
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
  RingSurvey ring_;              ///< of the fan; set by the check that precedes a collapse
  float estimate_ = 0.0F;        ///< of the distance from the input; set by the same check
  std::optional<IntersectionGuard> guard_;
  std::uint16_t least_rank_;
  CollapseOutcome outcome_;
};

}  // namespace mesher::simplify
