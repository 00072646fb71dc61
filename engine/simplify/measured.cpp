#include "engine/simplify/measured.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

#include "engine/analysis/hausdorff.h"
#include "engine/core/progress.h"
#include "engine/simplify/error_bound.h"
#include "engine/simplify/recheck.h"

namespace mesher::simplify {
namespace {

/// Fraction of the bound that collapses may use. The rest covers deviations between the points that
/// they check. Distances well below the bound are also quicker to decide.
constexpr double kUsedOfBound = 0.86;
/// Same, after a run that exceeded the bound: each run deviates in different places.
constexpr double kUsedAfterFailure = 0.82;
/// Same, if the bound is fine (`is_fine`): then there are few such points between which a face may
/// deviate.
constexpr double kUsedOfFineBound = 0.56;
/// Target ratio of the reported distance's upper to its lower bound, unless that takes too much
/// work.
constexpr double kRatioOfMeasured = 2.0;
/// Factor for the bound of the next run in places that exceeded it.
constexpr std::array<float, 4> kTighter{0.85F, 0.6F, 0.45F,
                                        0.3F};  // for the first run, the second, …
/// After this many runs, an undecided decision gets this many times as many queries.
constexpr int kRunsBeforeEffort = 4;
constexpr std::uint64_t kEffort = 16;

/// Times of simplifying and of bounding the distance, measured with 0.1 and 1.4 million faces.
constexpr double kCertifiedWeights[] = {0.78, 0.22};
/// Times of a run's stages: simplifying, deciding whether it is within the bound, and, for the last
/// run, measuring the distance. Measured as above.
constexpr double kDecidedWeights[] = {0.83, 0.13, 0.04};
/// Share of the remaining progress that a run gets. Two to four runs are usual.
constexpr double kShareOfRun = 0.35;

/// `before`: a tree of the input. `recheck`: if not null, only these faces count.
analysis::HausdorffBounds bounds_of(const Trace& trace, analysis::LazyTree& before,
                                    const analysis::HausdorffOptions& options,
                                    const Recheck* recheck = nullptr) {
  analysis::LazyTree after(trace.after, analysis::TriangleOrder::presorted);
  analysis::HausdorffSide input{trace.before, before, trace.near_before};
  analysis::HausdorffSide result{trace.after, after, trace.near_after};
  if (recheck != nullptr) {
    input.only = recheck->before;
    result.only = recheck->after;
  }
  return analysis::hausdorff_bounds(input, result, options);
}

analysis::HausdorffBounds decide(const Trace& trace, analysis::LazyTree& before,
                                 const SimplifyOptions& options, const Recheck* recheck,
                                 std::uint64_t effort = 1) {
  return bounds_of(
      trace, before,
      {.enough = options.max_error,
       .is_decision = true,
       .most_queries = effort * (500'000 + 20 * std::uint64_t{trace.before.face_count()}),
       .finds_all = true,
       .progress = options.progress},
      recheck);
}

/// Returns `faces` plus the faces of the input that map to the same vertices of the result.
std::vector<Face> with_surroundings(const Trace& trace, std::span<const Face> faces) {
  const Mesh& after = trace.after;
  Array<bool> is_near;
  is_near.assign(after.vertex_count(), false);
  for (const Face f : faces) {
    for (std::uint32_t c = 0; c < 3; ++c)
      is_near[after.origin(Mesh::halfedge(trace.near_before[f.index()], c)).index()] = true;
  }
  std::vector<Face> all(faces.begin(), faces.end());
  for (std::uint32_t f = 0; f < trace.before.face_count(); ++f) {
    const Face near = trace.near_before[f];
    bool is_around = true;
    for (std::uint32_t c = 0; c < 3; ++c)
      is_around &= is_near[after.origin(Mesh::halfedge(near, c)).index()];
    if (is_around) all.emplace_back(f);
  }
  return all;
}

/// Tightens the bound at the corners of the faces.
void tighten(Array<float>& shares, const Trace& trace, std::span<const Face> faces, float part) {
  const Mesh& before = trace.before;
  if (shares.empty()) shares.assign(before.vertex_count(), 1.0F);
  Array<bool> is_near;
  is_near.assign(before.vertex_count(), false);
  for (const Face f : faces) {
    for (std::uint32_t c = 0; c < 3; ++c)
      is_near[before.origin(Mesh::halfedge(f, c)).index()] = true;
  }
  for (std::size_t v = 0; v < shares.size(); ++v) {
    if (is_near[v]) shares[v] *= part;
  }
}

/// Returns the distance of the surfaces. Separate from the decision, which only finds out whether
/// the distance is within the bound.
analysis::DistanceInterval measure(const Trace& trace, analysis::LazyTree& before,
                                   double known_upper, const SimplifyOptions& options) {
  if (trace.before.face_count() == 0 || trace.after.face_count() == 0) return {};
  return bounds_of(trace, before,
                   {.ratio = kRatioOfMeasured,
                    .known_upper = known_upper,
                    .most_queries = trace.before.face_count(),
                    .progress = options.progress})
      .two_sided();
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Decides whether the result of a run is within the bound. Later runs take more trouble.
/// `earlier`: the run before, if any.
analysis::HausdorffBounds decide_in_run(int run, const Trace& trace, analysis::LazyTree& before,
                                        const std::optional<Decided>& earlier,
                                        const SimplifyOptions& options) {
  std::optional<Recheck> recheck;
  if (earlier) recheck = faces_to_recheck(trace, *earlier, options.max_error, before);
  const Recheck* const only = recheck ? &*recheck : nullptr;
  analysis::HausdorffBounds bounds = decide(trace, before, options, only);
  // No point beyond the bound is known, so the result is worth more work.
  const auto [lower, upper] = bounds.two_sided();
  if (run >= kRunsBeforeEffort && lower <= options.max_error && upper > options.max_error) {
    bounds = decide(trace, before, options, only, kEffort);
  }
  // Of the other faces only the decision is known.
  if (recheck) bounds.forward.upper = std::max(bounds.forward.upper, options.max_error);
  return bounds;
}

/// Adds the times of a run, all but that of measuring.
void add(SimplifyTimes& total, const SimplifyTimes& run) {
  total.prepare += run.prepare;
  total.collapse += run.collapse;
  total.finish += run.finish;
}

/// A result that is within the bound, with its distance from the input.
Simplified measured(Simplified&& result, const Trace& trace, analysis::LazyTree& before,
                    const analysis::HausdorffBounds& bounds, const SimplifyOptions& options,
                    const SimplifyTimes& spent) {
  const auto start = std::chrono::steady_clock::now();
  const auto [lower, upper] = bounds.two_sided();
  const analysis::DistanceInterval distance = measure(trace, before, upper, options);
  result.report.measured_error = std::max(lower, distance.lower);
  result.report.certified_bound = std::min(upper, distance.upper);
  result.report.seconds = spent;
  result.report.seconds.measure += seconds_since(start);
  return std::move(result);
}

/// The input, for a bound that no run has met. `spent`: times and refusals of the runs.
Simplified unchanged(const Mesh& input, const SimplifyOptions& options,
                     const SimplifyReport& spent) {
  SimplifyOptions no_collapse = options;
  no_collapse.observer = nullptr;
  no_collapse.target_faces = input.face_count();
  Simplified result = simplify_unmeasured(Mesh(input), no_collapse);
  result.report.faces_asked = options.target_faces;
  result.report.reason = StopReason::error_bound;
  result.report.rejected = spent.rejected;
  result.report.measured_error = 0.0;
  result.report.certified_bound = 0.0;
  result.report.seconds = spent.seconds;
  return result;
}

}  // namespace

Simplified simplify_certified(Mesh&& mesh, const SimplifyOptions& options) {
  Stages stages(options.progress, kCertifiedWeights);
  stages.next();
  Trace trace;
  Simplified result = simplify_unmeasured(std::move(mesh), options, &trace);
  stages.next();
  const auto start = std::chrono::steady_clock::now();
  analysis::DistanceInterval distance;
  if (result.mesh.face_count() > 0) {
    const double ratio = bound_ratio(result.report.faces_before);
    analysis::LazyTree before(trace.before, analysis::TriangleOrder::presorted);
    distance = bounds_of(trace, before, {.ratio = ratio, .progress = options.progress}).two_sided();
  }
  result.report.certified_bound = distance.upper;
  result.report.seconds.measure = seconds_since(start);
  return result;
}

Simplified simplify_measured(Mesh&& mesh, const SimplifyOptions& options) {
  const Mesh input = std::move(mesh);
  SimplifyOptions run_options = options;
  const bool is_fine = simplify::is_fine(input, options.max_error);
  run_options.max_error *= is_fine ? kUsedOfFineBound : kUsedOfBound;
  Attempts attempts;
  Trace trace;
  analysis::LazyTree before(trace.before, analysis::TriangleOrder::presorted);
  std::optional<Decided> earlier;
  SimplifyReport spent;
  OpenStages runs(options.progress, kShareOfRun);
  for (int run = 0; run < kMaxRuns; ++run) {
    runs.next();
    Stages parts(options.progress, kDecidedWeights);
    parts.next();
    CollapseRecorder recorder;
    run_options.observer = options.observer == nullptr ? nullptr : &recorder;
    Simplified result = simplify_unmeasured(Mesh(input), run_options, &trace, &attempts);
    parts.next();
    const auto start = std::chrono::steady_clock::now();
    analysis::HausdorffBounds bounds;
    if (input.face_count() > 0 && result.mesh.face_count() > 0)
      bounds = decide_in_run(run, trace, before, earlier, options);
    add(spent.seconds, result.report.seconds);
    spent.seconds.measure += seconds_since(start);
    if (bounds.two_sided().upper <= options.max_error) {
      parts.next();
      if (options.observer != nullptr) options.observer->collapsed(recorder.records());
      return measured(std::move(result), trace, before, bounds, options, spent.seconds);
    }
    spent.rejected = result.report.rejected;
    if (!is_fine) run_options.max_error = kUsedAfterFailure * options.max_error;
    if (run_options.max_error <= 0.0) break;  // the bound cannot get any tighter
    // Where faces are small, a safety margin costs hardly any extra faces.
    tighten(attempts.shares, trace,
            is_fine ? with_surroundings(trace, bounds.beyond) : bounds.beyond,
            kTighter[std::min<std::size_t>(static_cast<std::size_t>(run), kTighter.size() - 1)]);
    earlier = {std::move(trace.after), std::move(trace.near_after), std::move(bounds)};
  }
  return unchanged(input, options, spent);
}

}  // namespace mesher::simplify
