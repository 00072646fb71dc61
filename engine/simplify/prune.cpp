#include "engine/simplify/prune.h"

#include "engine/simplify/attribute_metric.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/analysis/distance.h"
#include "engine/analysis/hausdorff.h"
#include "engine/core/assert.h"
#include "engine/core/progress.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/reorder.h"

namespace mesher::simplify {
namespace {

/// Size limits of the parts left out, as fractions of the error. The whole error may leave out too
/// much if it is large only because the parts use up the faces.
constexpr double kThresholds[] = {1.0, 0.5, 0.25, 0.125};
// An error larger by this factor counts as equal, because the estimate is not more precise.
constexpr double kNoWorse = 1.05;
// A run that leaves out fewer parts must improve the error by this factor.
constexpr double kClearlyBetter = 0.9;
constexpr std::uint64_t kSamples = 4096;
/// Times of all runs, and of certifying the result.
constexpr double kCertifiedPruning[] = {1.0, 1.0};
constexpr double kPruningOnly[] = {1.0, 0.0};
/// Times of simplifying the rest, and of measuring what was left out.
constexpr double kPrunedRunWeights[] = {1.0, 0.1};

struct Part {
  Box box;
  double size = 0.0;  ///< diagonal of the bounding box
  double area = 0.0;
  std::uint32_t faces = 0;
};

/// The parts of a mesh: components, united if they touch at bow-tie vertices.
class Parts {
 public:
  explicit Parts(const Mesh& mesh) : of_face_(face_components(mesh)) {
    unite_bow_ties(mesh);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
      add(mesh, Face(f));
    for (Part& part : parts_) {
      part.size = part.box.diagonal();
      area_ += part.area;
    }
    for (std::size_t p = 1; p < parts_.size(); ++p) {
      if (parts_[p].size > parts_[largest_].size) largest_ = p;
    }
  }

  std::span<const Part> all() const { return parts_; }
  double area() const { return area_; }
  /// The largest part is never small, so the result is never empty.
  bool is_small(std::size_t part, double size) const {
    return part != largest_ && parts_[part].size < size;
  }
  /// Returns the number of small parts.
  std::size_t count_small(double size) const {
    std::size_t count = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      count += parts_[p].faces > 0 && is_small(p, size) ? 1 : 0;
    return count;
  }

  /// Returns the small parts, or all others; isolated vertices belong to the others.
  KeptIds select(const Mesh& mesh, double size, bool small) const {
    KeptIds kept;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
      const Halfedge h = mesh.outgoing(Vertex(v));
      const bool is = h.is_valid() && is_small(of_face_[Mesh::face(h).index()], size);
      if (is == small) kept.vertices.emplace_back(v);
    }
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      if (is_small(of_face_[f], size) == small) kept.faces.emplace_back(f);
    }
    return kept;
  }

 private:
  void unite_bow_ties(const Mesh& mesh) {
    const std::uint32_t count =
        of_face_.empty() ? 0 : *std::max_element(of_face_.begin(), of_face_.end()) + 1;
    parts_.resize(count);
    std::vector<std::uint32_t> into(count);
    std::iota(into.begin(), into.end(), 0U);
    const auto root = [&](std::uint32_t p) {
      while (into[p] != p)
        p = into[p] = into[into[p]];
      return p;
    };
    const auto part_at = [&](Vertex v) {
      return root(of_face_[Mesh::face(mesh.outgoing(v)).index()]);
    };
    for (const BowTieCopy& copy : mesh.bow_tie_copies()) {
      const auto [low, high] = std::minmax({part_at(copy.first), part_at(copy.v)});
      into[high] = low;
    }
    for (std::uint32_t& p : of_face_)
      p = root(p);
  }

  void add(const Mesh& mesh, Face f) {
    Part& part = parts_[of_face_[f.index()]];
    const auto corner = [&](std::uint32_t c) {
      return mesh.position(mesh.origin(Mesh::halfedge(f, c)));
    };
    if (part.faces == 0) part.box = {corner(0), corner(0)};
    for (std::uint32_t c = 0; c < 3; ++c) {
      part.box.min = glm::min(part.box.min, corner(c));
      part.box.max = glm::max(part.box.max, corner(c));
    }
    const glm::dvec3 a = corner(0);
    part.area +=
        0.5 * glm::length(glm::cross(glm::dvec3(corner(1)) - a, glm::dvec3(corner(2)) - a));
    ++part.faces;
  }

  std::vector<std::uint32_t> of_face_;
  std::vector<Part> parts_;  ///< by lowest component; the other components of a part have no faces
  double area_ = 0.0;
  std::size_t largest_ = 0;
};

/// Runs with different pruning limits and keeps the best result.
class Pruning {
 public:
  Pruning(const Mesh& input, const SimplifyOptions& options)
      : input_(input), parts_(input), options_(options), runs_(options.progress) {
    options_.certifies = false;
    best_ = run(0.0);
    unpruned_ = best_.report.estimated_error;
  }

  /// Tries the limits that the error of the best run suggests. Returns whether one was better.
  bool improve() {
    const double error = best_.report.estimated_error;
    bool is_better = false;
    std::size_t pruned_before = best_.report.pruned_parts;
    for (const double part : kThresholds) {
      const std::size_t pruned = parts_.count_small(part * error);
      if (pruned == 0) break;
      if (std::exchange(pruned_before, pruned) == pruned) continue;
      is_better = consider(run(part * error)) || is_better;
    }
    return is_better;
  }

  bool misses_target() const { return beyond_target(best_) > 0; }

  Simplified take() {
    best_.report.error_unpruned = unpruned_;
    best_.report.seconds = seconds_;
    return std::move(best_);
  }

 private:
  std::uint32_t beyond_target(const Simplified& result) const {
    const std::uint32_t faces = result.mesh.face_count();
    return faces > options_.target_faces ? faces - options_.target_faces : 0;
  }

  bool consider(Simplified&& result) {
    const std::uint32_t beyond = beyond_target(result);
    const std::uint32_t least = beyond_target(best_);
    const double margin = best_.report.pruned_parts == 0 ? kNoWorse : kClearlyBetter;
    const bool is_better =
        beyond != least ? beyond < least
                        : result.report.estimated_error <= margin * best_.report.estimated_error;
    if (is_better) best_ = std::move(result);
    return is_better;
  }

  /// Simplifies all parts except the small ones.
  Simplified run(double size) {
    runs_.next();
    Stages stages(options_.progress, kPrunedRunWeights);
    stages.next();
    const KeptIds kept = parts_.select(input_, size, false);
    const bool is_whole = kept.faces.size() == input_.face_count();
    SimplifyOptions options = options_;
    AttributeMetric metric;
    if (options.metric != nullptr && !is_whole) {
      metric = of_faces(*options.metric, kept.faces);
      options.metric = &metric;
    }
    Simplified result = simplify(is_whole ? Mesh(input_) : compact(input_, kept), options);
    for (Vertex& source : result.vertex_source)
      source = kept.vertices[source.index()];
    for (Face& source : result.face_source)
      source = kept.faces[source.index()];
    SimplifyReport& report = result.report;
    seconds_ += report.seconds;
    report.faces_before = input_.face_count();
    report.vertices_before = input_.vertex_count();
    stages.next();
    if (!is_whole) count_pruned(result, size);
    return result;
  }

  void count_pruned(Simplified& result, double size) {
    SimplifyReport& report = result.report;
    if (report.reason == StopReason::already_there) report.reason = StopReason::target_reached;
    double area = 0.0;
    for (std::size_t p = 0; p < parts_.all().size(); ++p) {
      const Part& part = parts_.all()[p];
      if (part.faces == 0 || !parts_.is_small(p, size)) continue;
      ++report.pruned_parts;
      report.pruned_faces += part.faces;
      report.largest_pruned = std::max(report.largest_pruned, part.size);
      area += part.area;
    }
    if (!(area > 0.0) || result.mesh.face_count() == 0) return;
    const auto start = std::chrono::steady_clock::now();
    const Mesh pruned = compact(input_, parts_.select(input_, size, true));
    const double far =
        analysis::surface_distance(pruned, result.mesh,
                                   {.samples = kSamples, .progress = options_.progress})
            .forward.rms;
    const double part = area / parts_.area();
    const double near = report.estimated_error;
    report.estimated_error = std::sqrt((1.0 - part) * near * near + part * far * far);
    seconds_.measure +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  const Mesh& input_;
  Parts parts_;
  SimplifyOptions options_;
  OpenStages runs_;
  Simplified best_;
  double unpruned_ = 0.0;
  SimplifyTimes seconds_;
};

Simplified pruned(const Mesh& input, const SimplifyOptions& options) {
  Pruning pruning(input, options);
  for (int i = 0; i < kMaxPrunings && pruning.improve() && pruning.misses_target(); ++i) {
  }
  return pruning.take();
}

}  // namespace

Simplified simplify_pruned(Mesh&& mesh, const SimplifyOptions& options) {
  MESHER_ASSERT(options.observer == nullptr && !std::isfinite(options.max_error));
  const Mesh input = std::move(mesh);
  Stages stages(options.progress, options.certifies ? kCertifiedPruning : kPruningOnly);
  stages.next();
  Simplified result = pruned(input, options);
  stages.next();
  if (options.certifies && result.mesh.face_count() > 0) {
    const auto start = std::chrono::steady_clock::now();
    const analysis::HausdorffOptions certified{.ratio = bound_ratio(input.face_count()),
                                               .progress = options.progress};
    result.report.certified_bound =
        analysis::hausdorff_bounds(input, result.mesh, certified).two_sided().upper;
    result.report.seconds.measure +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return result;
}

}  // namespace mesher::simplify
