#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "engine/analysis/self_intersections.h"
#include "engine/core/array.h"
#include "engine/simplify/attempts.h"
#include "engine/simplify/attribute_field.h"
#include "engine/simplify/collapser.h"
#include "engine/simplify/error_bound.h"
#include "engine/simplify/error_samples.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/options.h"
#include "engine/simplify/report.h"

namespace mesher::simplify {

/// Translates records in place, from the mesh's ids to those the observer expects.
using TranslateRecords = std::function<void(std::span<CollapseRecord>)>;

/// Which collapses are checked for new intersections.
enum class Guarding : std::uint8_t {
  none,
  /// Those near places where intersections appear otherwise. The result is looked over, and a part
  /// of the work is repeated if two faces intersect that did not before.
  where_needed,
  everywhere,  ///< all, so that no intermediate mesh has new intersections either
};

/// Simplifies in rounds. Each round cuts the vertices into regions of about kRegionVertices along a
/// Morton curve, sets a threshold that covers the cheapest fraction of all vertices, and collapses
/// the cheaper edges of every region independently: in parallel, and with all data of a region in
/// the second-level cache. The grid shifts from round to round, so edges at a region's border are
/// processed in a later round. Once the mesh is small or the target near, one region finishes the
/// work in exact order. Regions, thresholds and budgets depend on the mesh only, so the result is
/// the same for any number of threads.
class Rounds {
 public:
  /// `scale`: factor by which the mesh's units were multiplied. `translate`: applied to records
  /// before the observer sees them, on several threads. `attempts`: if not null, the shares of the
  /// error bound and the run to repeat; replaced by this run.
  Rounds(Mesh&& mesh, float scale, const SimplifyOptions& options, TranslateRecords translate,
         Attempts* attempts = nullptr, Guarding guarding = Guarding::none);

  /// Collapses edges down to the target and fills in the corresponding part of the report. Throws
  /// Cancelled.
  void run(SimplifyReport& report);

  const Surface& surface() const { return surface_; }
  /// Returns the attributes of the remaining faces, or null if the options have no metric.
  const AttributeField* attributes() const { return policy_->attributes(); }
  /// Returns the vertices that `run` left, in unspecified order.
  Array<Vertex> vertices_left() const;

 private:
  /// The budget of a round.
  struct Share {
    float cost;   ///< highest allowed cost
    double part;  ///< fraction of the vertices at or below that cost that may be collapsed
  };

  /// What the work changes.
  struct Saved {
    Surface surface;
    AttributeField::Saved attributes;
    ErrorBound::Saved bound;
    std::optional<TrackedSamples> tracked;
    Array<Vertex> live;
    std::size_t untold;
    std::size_t steps;
    std::uint32_t faces;
    std::uint64_t collapses;
    double paid;
    std::array<std::uint64_t, kRejections.size()> rejected;
    bool meets_bound;
    bool has_postponed;
    std::uint32_t removed_faces;
  };

  std::uint32_t faces_to_remove() const {
    return faces_ > options_.target_faces ? faces_ - options_.target_faces : 0;
  }
  bool repeats() const;
  void repeat_last_attempt();
  void run_rounds();
  void run_without_intersections();
  std::vector<analysis::FacePair> find_pairs(const Saved& start, const Surface& surface) const;
  std::vector<analysis::FacePair> repeat_the_end(Saved& start, Saved& before_end,
                                                 std::vector<analysis::FacePair> pairs);
  Saved save() const;
  void restore(const Saved& saved);
  void guard_from(Saved& saved, const Surface& later, std::span<const analysis::FacePair> pairs);
  void guard_all();
  std::size_t move_guarded_last(std::uint32_t round);
  void make_space();
  bool is_far() const;
  bool is_last_round() const;
  void run_regions(std::uint32_t round);
  void run_to_the_end();
  void run_to_the_error();
  std::uint32_t next_step(double error) const;
  void collapse_to(std::uint32_t faces);
  void free_seams_below(std::uint32_t limit, std::uint32_t faces);
  void collapse_region(std::uint32_t faces);
  void count_constrained();
  bool try_refused_again(std::size_t valence, std::uint32_t faces);
  Share share(std::span<const float> costs) const;
  CollapseOutcome translated(CollapseOutcome&& outcome) const;
  void tell(std::span<const CollapseRecord> records);
  void note(const CollapseOutcome& outcome);
  void drop_removed();
  StopReason reason() const;
  double paid_error() const;
  double estimated_error() const;

  const SimplifyOptions& options_;
  TranslateRecords translate_;
  float scale_;
  Attempts* attempts_;
  std::unique_ptr<ErrorBound> bound_;
  Guarding guarding_;
  std::unique_ptr<GuardedSpace> space_;  ///< null while no collapse is checked
  Surface surface_;
  ErrorSamples samples_;
  std::optional<TrackedSamples> tracked_;  ///< set once few faces are left
  std::unique_ptr<CollapsePolicy> policy_;
  Array<QueueEntry> queue_;
  CollapseContext context_;
  Array<Vertex> live_;      ///< vertices with faces
  Array<Vertex> isolated_;  ///< vertices that never had a face
  std::uint32_t faces_;
  std::uint32_t faces_before_;
  std::uint64_t collapses_ = 0;
  double paid_ = 0.0;
  std::array<std::uint64_t, kRejections.size()> rejected_{};
  bool meets_bound_ = false;    ///< an edge was refused because of the error bound
  bool has_postponed_ = false;  ///< as in CollapseOutcome, since refused edges were last tried
  Array<CollapseStep> steps_;   ///< only if there is an error bound
  /// Records of collapses that may still be undone; if none, the observer is notified at once.
  std::optional<Array<CollapseRecord>> held_;
  /// Records of collapses that may be repeated otherwise.
  std::optional<Array<CollapseRecord>> untold_;
  /// Set if the next collapses exceeded `stop_before_error`: the error without them.
  std::optional<double> error_at_stop_;
};

}  // namespace mesher::simplify
