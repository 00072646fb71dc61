#include "engine/simplify/simplify_model.h"

#include <utility>

#include "engine/core/progress.h"
#include "engine/simplify/attribute_metric.h"
#include "engine/simplify/carry_attributes.h"
#include "engine/simplify/prune.h"

namespace mesher::simplify {
namespace {

/// Times of simplifying, and of carrying attributes over.
constexpr double kModelWeights[] = {0.8, 0.2};

}  // namespace

SimplifiedModel simplify_model(Mesh&& mesh, const Attributes& attributes,
                               const SimplifyOptions& options, bool prunes) {
  const auto run = [&](Mesh&& input, const AttributeMetric* metric) {
    SimplifyOptions run_options = options;
    run_options.metric = metric != nullptr && metric->size > 0 ? metric : nullptr;
    run_options.crosses_seams = options.target_faces > 0;
    return prunes ? simplify_pruned(std::move(input), run_options)
                  : simplify(std::move(input), run_options);
  };
  SimplifiedModel result;
  const bool has_lines = may_have_lines(attributes);
  if (attributes.layers.empty() && !has_lines) {
    result.simplified = run(std::move(mesh), nullptr);
    result.attributes = carried_groups(attributes, result.simplified.face_source);
    return result;
  }
  Stages stages(options.progress, kModelWeights);
  stages.next();
  Mesh marked(mesh);
  mark_seams(marked, attributes);
  const AttributeMetric metric = attribute_metric(mesh, attributes, options.weights());
  result.simplified = run(std::move(marked), &metric);
  result.crosses_seams = result.simplified.corners.crosses_seams;
  const bool is_stuck = result.simplified.report.reason == StopReason::no_legal_collapse &&
                        result.simplified.report.faces_reached > options.target_faces;
  if (has_lines && options.target_faces > 0 && is_stuck) {
    Simplified across = run(Mesh(mesh), nullptr);
    if (across.report.faces_reached < result.simplified.report.faces_reached) {
      result.crosses_seams = true;
      result.simplified = std::move(across);
    }
  }
  unmark_seams(result.simplified.mesh);
  stages.next();
  result.attributes =
      carry_attributes({mesh, attributes}, result.simplified, metric, options.progress);
  return result;
}

}  // namespace mesher::simplify
