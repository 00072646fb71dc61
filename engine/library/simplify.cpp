#include <mesher/asset.h>
#include <mesher/error.h>

#include <cmath>

#include "engine/library/asset_data.h"
#include "engine/library/simplify_rules.h"
#include "engine/library/watch.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/simplify_model.h"

namespace mesher {
namespace {

/// Passes collapses on to the observer of the face: at once if there is one run, and otherwise
/// those of the run that counts, when it is known.
class CollapseRelay : public simplify::CollapseObserver {
 public:
  using Observer = std::function<void(std::span<const EdgeCollapse>)>;

  CollapseRelay(const Observer& observer, bool has_one_run)
      : observer_(observer), has_one_run_(has_one_run) {}

  void expect(std::size_t collapses) override {
    if (!has_one_run_) runs_.emplace_back().reserve(collapses);
  }
  void collapsed(std::span<const simplify::CollapseRecord> records) override {
    if (!has_one_run_) {
      if (runs_.empty()) runs_.emplace_back();
      runs_.back().insert(runs_.back().end(), records.begin(), records.end());
      return;
    }
    pass_on(records);
  }
  void finish(bool last_run_counts) {
    if (!runs_.empty()) pass_on(last_run_counts ? runs_.back() : runs_.front());
  }

 private:
  void pass_on(std::span<const simplify::CollapseRecord> records) {
    std::vector<EdgeCollapse> collapses;
    collapses.reserve(records.size());
    for (const simplify::CollapseRecord& r : records) {
      collapses.push_back(
          {.removed = r.removed.index(),
           .kept = r.kept.index(),
           .position = {r.position.x, r.position.y, r.position.z},
           .face = Mesh::face(r.halfedge).index(),
           .other_face = r.twin.is_valid() ? Mesh::face(r.twin).index() : kNoElement});
    }
    observer_(collapses);
  }

  const Observer& observer_;
  bool has_one_run_;
  std::vector<Array<simplify::CollapseRecord>> runs_;
};

void check_options(const SimplifyOptions& options) {
  if (!(options.max_error > 0.0)) throw UsageError("simplify: max_error is not above 0");
  if (!options.prune) return;
  if (std::isfinite(options.max_error))
    throw UsageError("simplify: a pruned part may be farther away than max_error");
  if (options.collapsed)
    throw UsageError("simplify: pruning is no sequence of collapses that could be observed");
}

simplify::SimplifyOptions engine_options(const SimplifyOptions& options) {
  simplify::SimplifyOptions result = engine_rules(options);
  result.target_faces = options.target_faces;
  result.max_error = options.max_error;
  result.certifies = options.certify;
  result.seed = options.seed;
  result.no_intersections = options.no_intersections;
  return result;
}

SimplifyReport face_report(const simplify::SimplifiedModel& result) {
  static_assert(int(StopReason::far_from_input) == int(simplify::StopReason::far_from_input));
  const simplify::SimplifyReport& r = result.simplified.report;
  return {.faces_before = r.faces_before,
          .faces_reached = r.faces_reached,
          .collapses = r.collapses,
          .reason = static_cast<StopReason>(r.reason),
          .estimated_error = r.estimated_error,
          .certified_bound = r.certified_bound,
          .pruned_parts = r.pruned_parts,
          .crosses_seams = result.crosses_seams,
          .seconds = r.seconds.total()};
}

}  // namespace

void check_weights(const AttributeWeights& weights) {
  for (const float weight : {weights.texcoord, weights.normal, weights.color, weights.joint}) {
    if (!(weight >= 0.0F && std::isfinite(weight)))
      throw UsageError("simplify: a weight is below 0 or no number");
  }
}

Asset Asset::simplify(const SimplifyOptions& options, SimplifyReport* report) const {
  check_options(options);
  Watch watch(options.progress);
  CollapseRelay relay(options.collapsed, data_->model.attributes.is_empty());
  simplify::SimplifyOptions engine = engine_options(options);
  engine.progress = watch.progress();
  if (options.collapsed) engine.observer = &relay;
  begin_stage(engine.progress, "simplifying");

  auto data = std::make_shared<Data>(*data_);
  simplify::SimplifiedModel result = simplify::simplify_model(
      std::move(data->model.mesh), data_->model.attributes, engine, options.prune);
  relay.finish(result.crosses_seams);
  if (report != nullptr) *report = face_report(result);
  data->model.mesh = std::move(result.simplified.mesh);
  data->model.attributes = std::move(result.attributes);
  return Asset(std::move(data));
}

}  // namespace mesher
