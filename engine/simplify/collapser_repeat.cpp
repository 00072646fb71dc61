// The part of Collapser that repeats an earlier run.
#include "engine/core/progress.h"
#include "engine/mesh/circulators.h"
#include "engine/simplify/collapser.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kStepsAhead = 6;
constexpr std::size_t kStepsPerCheck = 4096;

}  // namespace

CollapseOutcome Collapser::repeat(std::span<const CollapseStep> steps, bool was_exhausted) {
  outcome_.records.reserve(steps.size());
  outcome_.steps.reserve(steps.size());
  // A face that exists now but not at this point of the earlier run, or the other way around, has
  // a corner that is marked here.
  Array<bool> differs;
  differs.assign(context_.surface.mesh().vertex_count(), false);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i % kStepsPerCheck == 0) check_cancelled(context_.progress);
    if (i + kStepsAhead < steps.size()) prefetch_ends(steps[i + kStepsAhead].record);
    const CollapseStep& step = steps[i];
    if (can_repeat(step, differs)) {
      apply_again(step);
    } else {
      differs[step.record.removed.index()] = true;
      differs[step.record.kept.index()] = true;
    }
  }
  context_.surface.recompute();
  if (was_exhausted) evaluate_near(differs);
  return std::move(outcome_);
}

void Collapser::prefetch_ends(const CollapseRecord& record) const {
  const Surface& surface = context_.surface;
  surface.will_need(record.removed);
  surface.will_need(record.kept);
  surface.will_need(record.halfedge);
  if (record.twin.is_valid()) surface.will_need(record.twin);
}

/// Leaves the fan gathered if the answer is yes.
bool Collapser::can_repeat(const CollapseStep& step, const Array<bool>& differs) {
  const Surface& surface = context_.surface;
  const auto& [h, t, removed, kept, position, rank] = step.record;
  const auto is_different = [&](Vertex v) { return differs[v.index()]; };
  if (is_different(removed) || is_different(kept)) return false;
  fan_.gather(surface, h, limits_.valence);
  if (std::ranges::any_of(fan_.ring(), is_different)) return false;
  const ErrorBound& bound = *context_.bound;
  return !(bound.is_tight(removed) || bound.is_tight(kept)) ||
         bound.allows_again(surface, fan_, step);
}

/// Changes the mesh only, and leaves shapes and quadrics to `Surface::recompute`, unless the policy
/// needs them on the way.
void Collapser::apply_again(const CollapseStep& step) {
  Surface& surface = context_.surface;
  if (context_.policy.attributes() != nullptr || context_.policy.has_history()) {
    fan_.check_shape(surface, step.record.position);
    return apply(step);
  }
  note(step);
  merge(step.record.halfedge, step.record.position);
  surface.move_and_clear_quadric(step.record.kept, step.record.position);
  context_.bound->collapsed(step);
  outcome_.steps.push_back(step);
}

/// Evaluates the edges at marked vertices and their neighbors. All others count as refused.
void Collapser::evaluate_near(const Array<bool>& differs) {
  const Surface& surface = context_.surface;
  const Mesh& mesh = surface.mesh();
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vertex v(i);
    if (i % kStepsPerCheck == 0) check_cancelled(context_.progress);
    if (mesh.is_isolated(v)) continue;
    state(v).has_refused = true;
    bool is_near = differs[i];
    for (const Vertex neighbor : vertices_around(mesh, v))
      is_near |= differs[neighbor.index()];
    if (!is_near) continue;
    evaluate_refused(v);
    choose_cheapest_edge(v);
    queue_.remove(v);
  }
}

}  // namespace mesher::simplify
