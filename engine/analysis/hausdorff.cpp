#include "engine/analysis/hausdorff.h"

#include <algorithm>
#include <glm/common.hpp>
#include <vector>

#include "engine/analysis/one_sided_bound.h"

namespace mesher::analysis {
namespace {

/// Distances below this fraction of the largest distance found so far need not be exact.
constexpr double kNearEnough = 0.25;
/// In a decision, the fraction of `enough` that corner distances may use; the rest is for the
/// points between them.
constexpr double kNearForDecision = 0.5;

/// Times of skimming or probing, of measuring the vertices of each side, and of refining: with
/// hints after simplifying 0.1 and 1.4 million faces, without hints comparing such meshes.
constexpr double kHintedWeights[] = {0.85, 0.01, 0.03, 0.11};
constexpr double kUnhintedWeights[] = {0.03, 0.18, 0.03, 0.76};
/// Times of measuring the vertices of each side, and of skimming its faces; as above.
constexpr double kSkimWeights[] = {0.2, 0.03, 0.45, 0.32};

double longest_coordinate(const Mesh& mesh) {
  float most = 0.0F;
  for (const Vertex v : mesh.origins()) {
    const glm::vec3 p = glm::abs(mesh.position(v));
    most = std::max({most, p.x, p.y, p.z});
  }
  return most;
}

void sort_unique(std::vector<Face>& faces) {
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

/// Both directions, which share the lower bound.
class BothSides {
 public:
  BothSides(const HausdorffSide& a, const HausdorffSide& b, const HausdorffOptions& options)
      : options_(options),
        rounding_(0x1p-48 * std::max(longest_coordinate(a.mesh), longest_coordinate(b.mesh))),
        forward_(a, b, rounding_),
        backward_(b, a, rounding_),
        has_hints_(!a.hints.empty() && !b.hints.empty()) {}

  HausdorffBounds run() {
    begin_stage(options_.progress, "bounding the distance");
    Stages stages(options_.progress, has_hints_ ? kHintedWeights : kUnhintedWeights);
    stages.next();
    if (has_hints_) {
      if (!options_.is_decision) forward_.find_farthest_vertex(options_.progress);
      if (options_.known_upper <= options_.ratio * lower()) return known();
      skim_both();
    } else {
      for (OneSidedBound* side : {&forward_, &backward_})
        side->probe();
    }
    for (OneSidedBound* side : {&forward_, &backward_}) {
      stages.next();
      side->measure_vertices(limits(), options_.progress);
    }
    stages.next();
    refine();
    HausdorffBounds bounds{.forward = {forward_.lower(), forward_.upper()},
                           .backward = {backward_.lower(), backward_.upper()},
                           .beyond = {},
                           .beyond_of_second = {}};
    if (options_.finds_all) find_beyond(bounds);
    return bounds;
  }

 private:
  HausdorffBounds known() const {
    const DistanceInterval distance{lower(), options_.known_upper};
    return {.forward = distance, .backward = distance, .beyond = {}, .beyond_of_second = {}};
  }
  /// Skims both surfaces first. Usually the second tree is then not needed, and for a decision
  /// neither is the first.
  void skim_both() {
    Progress* progress = options_.progress;
    Stages stages(progress, kSkimWeights);
    stages.next();
    if (options_.is_decision) {
      const double near = kNearForDecision * options_.enough;
      forward_.find_near_vertices(near, limits().allowed, progress);
      stages.next();
      backward_.find_near_vertices(near, limits().allowed, progress);
    } else {
      stages.next();
      backward_.find_near_vertices(lower(), limits().allowed, progress);
    }
    for (OneSidedBound* side : {&forward_, &backward_}) {
      stages.next();
      side->skim_faces(limits(), progress);
    }
  }
  void refine() {
    OpenStages rounds(options_.progress);
    while (is_open()) {
      rounds.next();
      for (OneSidedBound* side : {&forward_, &backward_}) {
        if (side->has_open() && is_open()) side->refine(limits(), options_.progress);
      }
    }
  }
  double lower() const { return std::max(forward_.lower(), backward_.lower()); }
  void find_beyond(HausdorffBounds& bounds) const {
    std::vector<Face>& faces = bounds.beyond;
    forward_.visit_beyond([&](const BoundPiece& piece) { faces.push_back(piece.face); });
    backward_.visit_beyond([&](const BoundPiece& piece) {
      bounds.beyond_of_second.push_back(piece.face);
      faces.insert(faces.end(), piece.near.begin(), piece.near.end());
      if (piece.below.is_valid()) faces.push_back(piece.below);
    });
    sort_unique(faces);
    sort_unique(bounds.beyond_of_second);
  }
  BoundLimits limits() const {
    const double known = options_.is_decision ? 0.0 : options_.ratio * lower();
    const double allowed = std::max({known, options_.enough, 2.0 * rounding_});
    if (!options_.finds_all) return {.near = kNearEnough * lower(), .allowed = allowed};
    return {.near = kNearEnough * std::min(lower(), options_.enough),
            .allowed = allowed,
            .beyond = options_.enough};
  }
  bool is_open() const {
    if (!forward_.has_open() && !backward_.has_open()) return false;
    if (options_.is_decision && !options_.finds_all && lower() > options_.enough) return false;
    return forward_.queries() + backward_.queries() < options_.most_queries;
  }

  const HausdorffOptions& options_;
  double rounding_;
  OneSidedBound forward_;
  OneSidedBound backward_;
  bool has_hints_;
};

}  // namespace

DistanceInterval HausdorffBounds::two_sided() const {
  return {.lower = std::max(forward.lower, backward.lower),
          .upper = std::max(forward.upper, backward.upper)};
}

HausdorffBounds hausdorff_bounds(const HausdorffSide& a, const HausdorffSide& b,
                                 const HausdorffOptions& options) {
  MESHER_ASSERT(a.mesh.face_count() > 0 && b.mesh.face_count() > 0);
  MESHER_ASSERT(options.ratio > 1.0);
  return BothSides(a, b, options).run();
}

HausdorffBounds hausdorff_bounds(const Mesh& a, const Mesh& b, const HausdorffOptions& options) {
  LazyTree tree_a(a);
  LazyTree tree_b(b);
  return hausdorff_bounds({a, tree_a}, {b, tree_b}, options);
}

}  // namespace mesher::analysis
