#include "engine/simplify/measured.h"

#include <algorithm>
#include <array>
#include <chrono>

#include "engine/analysis/distance.h"

namespace mesher {
namespace {

double measure(const Mesh& input, const Simplified& result, Progress* progress) {
  if (input.face_count() == 0 || result.mesh.face_count() == 0) return 0.0;
  const DistanceOptions options{
      .samples = std::max<std::uint64_t>(300'000, 4 * std::uint64_t{input.face_count()}),
      .progress = progress};
  return surface_distance(input, result.mesh, options).two_sided().max;
}

}  // namespace

Simplified simplify_measured(Mesh&& mesh, const SimplifyOptions& options) {
  const Mesh input = std::move(mesh);
  SimplifyOptions run_options = options;
  SimplifyTimes seconds;
  std::array<std::uint64_t, kRejectionCount> rejected{};
  for (int run = 0; run < kMaxRuns; ++run) {
    CollapseRecorder recorder;
    run_options.observer = options.observer == nullptr ? nullptr : &recorder;
    Simplified result = simplify_unmeasured(Mesh(input), run_options);
    const auto start = std::chrono::steady_clock::now();
    const double measured = measure(input, result, options.progress);
    seconds.prepare += result.report.seconds.prepare;
    seconds.collapse += result.report.seconds.collapse;
    seconds.finish += result.report.seconds.finish;
    seconds.measure +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (measured <= options.max_error) {
      if (options.observer != nullptr) options.observer->collapsed(recorder.records());
      result.report.measured_error = measured;
      result.report.seconds = seconds;
      return result;
    }
    rejected = result.report.rejected;
    if (run_options.max_error <= 0.0) break;  // no tighter bound is left
    // A little less than in proportion, so that few runs are needed.
    run_options.max_error *= 0.95 * options.max_error / measured;
  }
  run_options = options;
  run_options.observer = nullptr;
  run_options.target_faces = input.face_count();
  Simplified unchanged = simplify_unmeasured(Mesh(input), run_options);
  unchanged.report.faces_asked = options.target_faces;
  unchanged.report.reason = StopReason::error_bound;
  unchanged.report.rejected = rejected;
  unchanged.report.measured_error = 0.0;
  unchanged.report.seconds = seconds;
  return unchanged;
}

}  // namespace mesher
