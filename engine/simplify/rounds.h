#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "engine/core/array.h"
#include "engine/simplify/collapser.h"
#include "engine/simplify/error_bound.h"
#include "engine/simplify/error_samples.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/options.h"
#include "engine/simplify/report.h"

namespace mesher {

/// Turns records of the mesh's ids into those that the observer is told, in place.
using TranslateRecords = std::function<void(std::span<CollapseRecord>)>;

/// Simplifies in rounds. In each the vertices are cut into regions of about kRegionVertices along a
/// Morton curve, a threshold is set under which the cheapest part of all vertices lies, and every
/// region collapses what is cheaper, each on its own: in parallel, and with all that it touches in
/// the nearest cache. The grid is shifted from round to round, so that what lies at a border has
/// its turn in the next. What is left when the mesh is small or the target near is done in one
/// region, in exact order. Regions, thresholds and budgets follow from the mesh alone, so the
/// result is the same for any number of threads.
class Rounds {
 public:
  /// `scale`: what the mesh's units have been multiplied by. `translate`: records go through it on
  /// their way to the observer, some on each thread. `shares`: of the error bound, as ErrorBound.
  Rounds(Mesh&& mesh, float scale, const SimplifyOptions& options, TranslateRecords translate,
         Array<float> shares = {});

  /// Collapses down to the target and fills in what the report says of it. Throws Cancelled.
  void run(SimplifyReport& report);

  const Surface& surface() const { return surface_; }
  /// What `run` has left, in no order that means anything.
  Array<Vertex> vertices_left() const;

 private:
  /// What a round may collapse.
  struct Share {
    float cost;   ///< the dearest
    double part;  ///< of the vertices that are as cheap
  };

  std::uint32_t faces_to_remove() const {
    return faces_ > options_.target_faces ? faces_ - options_.target_faces : 0;
  }
  bool is_far() const;
  bool is_last_round() const;
  void run_regions(std::uint32_t round);
  void run_to_the_end();
  void run_to_the_error();
  std::uint32_t next_step(double error) const;
  void collapse_to(std::uint32_t faces);
  void collapse_region(std::uint32_t faces);
  void count_constrained();
  bool try_refused_again(std::size_t valence, std::uint32_t faces);
  Share share(std::span<const float> costs) const;
  CollapseOutcome translated(CollapseOutcome&& outcome) const;
  void tell(std::span<const CollapseRecord> records) const;
  void note(const CollapseOutcome& outcome);
  void drop_removed();
  StopReason reason() const;
  double paid_error() const;
  double estimated_error() const;

  const SimplifyOptions& options_;
  TranslateRecords translate_;
  float scale_;
  std::unique_ptr<ErrorBound> bound_;
  std::unique_ptr<GuardedSpace> space_;
  Surface surface_;
  ErrorSamples samples_;
  std::optional<TrackedSamples> tracked_;  ///< once few faces are left
  std::unique_ptr<CollapsePolicy> policy_;
  Array<QueueEntry> queue_;
  CollapseContext context_;
  Array<Vertex> live_;      ///< that have faces
  Array<Vertex> isolated_;  ///< that never had any
  std::uint32_t faces_;
  std::uint32_t faces_before_;
  std::uint64_t collapses_ = 0;
  double paid_ = 0.0;
  std::array<std::uint64_t, kRejections.size()> rejected_{};
  /// Of collapses that may be taken back; none: the observer is told at once.
  std::optional<Array<CollapseRecord>> held_;
  /// Where the next collapses passed `stop_before_error`: the error without them.
  std::optional<double> error_at_stop_;
};

}  // namespace mesher
