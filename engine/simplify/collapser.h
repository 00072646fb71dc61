#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/simplify/bucket_queue.h"
#include "engine/simplify/cost_policy.h"
#include "engine/simplify/error_bound.h"
#include "engine/simplify/fan.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/report.h"
#include "engine/simplify/surface.h"

namespace mesher {

/// What is known of each edge's cost and each vertex's cheapest edge, beside the surface. A vertex
/// stands for its edges in the queue, so that there is one entry for each.
///
/// A cost may be out of date: a collapse evaluates the edges of its own vertex, not those of the
/// neighbours. An edge is looked at again when its turn comes (costs mostly rise, so that nothing
/// cheap is missed).
struct Schedule {
  /// By half-edge. An edge has its cost at one of its halves, whose origin answers for it; the
  /// other has kNever, and both have where the edge is refused.
  Array<float> edge_cost;
  Array<QueueEntry> vertices;

  explicit Schedule(const Surface& surface);
};

/// What stays the same over a whole simplification.
struct CollapseContext {
  Surface& surface;
  CollapsePolicy& policy;
  Schedule& schedule;
  ErrorBound* bound = nullptr;
  Care care = Care::exact;  ///< with which edges are looked at before their turn
  Progress* progress = nullptr;
  std::uint32_t faces_to_remove = 0;            ///< in all
  std::atomic<std::uint32_t> removed_faces{0};  ///< so far, for the progress
};

/// What came of the work on one region.
struct CollapseOutcome {
  std::uint32_t removed_faces = 0;
  double paid = 0.0;  ///< sum of Candidate::error
  Array<CollapseRecord> records;
  std::array<std::uint64_t, kRejectionCount> rejected{};
};

/// Gives every edge its first cost, and every vertex its cheapest edge. O(F), parallel. Throws
/// Cancelled.
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
    float cost = Candidate::kNever;  ///< nothing dearer is collapsed
    std::uint32_t tolerance = 0;     ///< buckets that an edge may be dearer than was thought
    /// At most so many are removed, or one more: a collapse inside the surface removes two. Where
    /// one is left to remove, a legal collapse at the boundary is preferred.
    std::uint32_t faces = 0;
    std::size_t valence = 0;  ///< no vertex of more faces is made
  };

  Collapser(CollapseContext& context, const Limits& limits);

  /// Works until nothing within the limits is left. Throws Cancelled. Call once.
  [[nodiscard]] CollapseOutcome run(std::span<const Vertex> vertices);
  /// The same, after all refused edges have been given a cost again.
  [[nodiscard]] CollapseOutcome run_refused(std::span<const Vertex> vertices);

 private:
  QueueEntry& entry(Vertex v) { return context_.schedule.vertices[v.index()]; }
  bool is_ours(Vertex v) { return entry(v).region == limits_.region; }
  void fill_queue(std::span<const Vertex> vertices);
  void empty_queue(std::span<const Vertex> vertices);
  void take_turns();
  void take_turn(Vertex v);
  bool remove_one_face(std::span<const Vertex> vertices);
  Candidate evaluate(Halfedge h);
  void choose_cheapest_edge(Vertex v);
  void wait_for(Vertex v, Halfedge best, float cost);
  void evaluate_fan(Vertex v);
  void evaluate_refused(Vertex v);
  void refuse(Halfedge h, Rejection cause);
  std::optional<Rejection> check(Halfedge h, const Candidate& candidate);
  void collapse(Halfedge h, const Candidate& candidate);
  std::uint16_t take_rank(Halfedge h, float cost);
  bool makes_feature_triangle(Halfedge h) const;
  void add_contributions(Face f, float sign);
  void merge(Halfedge h, const glm::vec3& p);
  void merge_near_feature(Halfedge h, const glm::vec3& p);
  void merge_smooth(Halfedge h, const glm::vec3& p);
  void wake_ring();

  CollapseContext& context_;
  Limits limits_;
  BucketQueue queue_;
  Fan fan_;
  std::vector<float> costs_;  ///< scratch of evaluate_fan
  bool has_refused_ = false;  ///< a vertex of the region has
  CollapseOutcome outcome_;
};

}  // namespace mesher
