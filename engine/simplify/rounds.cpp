#include "engine/simplify/rounds.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/simplify/attribute_field.h"
#include "engine/simplify/checkpoint.h"
#include "engine/simplify/morton.h"

namespace mesher::simplify {
namespace {

// The vertices and faces of a region (about 1 MB) fit into the second-level cache.
constexpr std::size_t kRegionVertices = 4096;
// With fewer vertices a single region is as fast, and its order is exact.
constexpr std::size_t kFewVertices = 6000;
// Fraction of the vertices, and of the faces still to be removed, that a round may collapse.
// Smaller fractions give more rounds, which follow the exact order more closely and take longer.
constexpr double kShareOfVertices = 0.7;
constexpr double kShareOfTarget = 0.7;
// If many costs are equal, the threshold lets through more than that fraction, so every region's
// budget is scaled down to this multiple of it in total. It still cannot exceed the target.
constexpr double kMostOfShare = 1.25;
// Rounds end when one removes less than this fraction of the vertices: if hardly any collapse is
// legal, a single region is cheaper.
constexpr std::size_t kVerticesPerLeastRound = 64;
// Rounds end when the vertices still to be removed are a small fraction of the mesh.
constexpr std::size_t kVerticesPerLastRemoved = 16;
// Tolerance: by how many buckets an edge may exceed its queued cost and still be collapsed at once.
// The order matters in the last halvings, whose errors are largest: an octave while at least three
// halvings remain, then a quarter octave, and nothing in the last round.
constexpr std::uint32_t kToleranceFarFromTarget = 32;
constexpr std::uint32_t kToleranceNearTarget = 8;
constexpr std::uint32_t kFarFromTarget = 8;
// A collapse that leaves more faces than this around a vertex is postponed until nothing else is
// left, so that no hub makes the work quadratic. Beyond the second limit it is refused.
constexpr std::size_t kUsualValence = 64;
constexpr std::size_t kLargestValence = 4096;
// The last steps have the largest errors, so all costs around a collapse are re-evaluated: when
// fewer faces are left than this fraction of the input, within limits.
constexpr std::uint32_t kFacesPerFresh = 64;
constexpr std::uint32_t kLeastFresh = 256;
constexpr std::uint32_t kMostFresh = 2048;
// If the error may end the work, it is estimated after steps that keep between these fractions of
// the faces. A step that exceeds the error is undone entirely, so the last steps must be fine; each
// step costs an estimate, so the first ones are coarse. The error is roughly inverse to the number
// of faces: a step aims at a quarter of the allowed error, which leaves room for one that grows
// four times as fast.
constexpr double kCoarsestStep = 0.25;
constexpr double kFinestStep = 0.9;
constexpr double kErrorMargin = 4.0;
// With so few faces all steps are fine: mostly corners are left, and the error jumps.
constexpr std::uint32_t kFewFaces = 256;
// With fewer faces, points of the input are tracked and costs are measured at them.
constexpr std::uint32_t kTrackedFaces = 512;
// With fewer faces than this fraction of the input, seams are free: most collapses left have to
// cross them, so their full price would only order the collapses by length.
constexpr std::uint32_t kFacesPerFreeSeams = 8;
// Number of faces per sample for measuring the distance from the input, within limits.
constexpr std::size_t kFacesPerSample = 16;
constexpr std::size_t kLeastSamples = 256;
constexpr std::size_t kMostSamples = 1024;
// Weight of the paid error per unit of uncertainty of the measured one. Both weigh the same if the
// mean square is known to a quarter.
constexpr double kTrustInPaid = 16.0;

std::unique_ptr<ErrorBound> make_bound(const Mesh& mesh, float scale,
                                       const SimplifyOptions& options, const Attempts* attempts) {
  if (!std::isfinite(options.max_error) || mesh.face_count() == 0) return nullptr;
  return std::make_unique<ErrorBound>(mesh, double{scale} * options.max_error,
                                      attempts != nullptr ? attempts->shares : Array<float>{});
}

}  // namespace

Rounds::Rounds(Mesh&& mesh, float scale, const SimplifyOptions& options, TranslateRecords translate,
               Attempts* attempts, Guarding guarding)
    : options_(options),
      translate_(std::move(translate)),
      scale_(scale),
      attempts_(attempts),
      bound_(make_bound(mesh, scale, options, attempts)),
      guarding_(guarding),
      surface_(std::move(mesh), options),
      samples_(surface_, std::clamp(surface_.mesh().face_count() / kFacesPerSample, kLeastSamples,
                                    kMostSamples)),
      policy_(make_policy(options, surface_)),
      queue_(surface_.mesh().vertex_count(), QueueEntry{}),
      context_{.surface = surface_,
               .policy = *policy_,
               .queue = queue_,
               .bound = bound_.get(),
               .progress = options.progress},
      faces_(surface_.mesh().face_count()),
      faces_before_(faces_) {
  for (std::uint32_t v = 0; v < surface_.mesh().vertex_count(); ++v)
    (surface_.mesh().is_isolated(Vertex(v)) ? isolated_ : live_).emplace_back(v);
  if (faces_to_remove() == 0) return;
  if (guarding_ == Guarding::where_needed && policy_->has_history()) {
    guarding_ = Guarding::everywhere;
  }
  if (guarding_ == Guarding::everywhere) guard_all();
  check_cancelled(options_.progress);
  if (repeats()) return;
  context_.precision = is_far() ? CostPrecision::guess : CostPrecision::exact;
  evaluate_all(context_);
}

/// Returns whether there is an attempt to repeat. New intersections are those that the start does
/// not have, so a run that must not make any starts with the input. So does one that frees seams,
/// because a step does not say whether they were free.
bool Rounds::repeats() const {
  return attempts_ != nullptr && !attempts_->steps.empty() && guarding_ == Guarding::none &&
         !surface_.can_free_seams();
}

void Rounds::repeat_last_attempt() {
  surface_.set_refused(std::move(attempts_->refused));
  rejected_ = attempts_->rejected;
  meets_bound_ = attempts_->meets_bound;
  context_.precision = CostPrecision::exact;
  Collapser collapser(context_, {.faces = kNone, .valence = kLargestValence});
  note(translated(collapser.repeat(attempts_->steps, attempts_->is_exhausted)));
  attempts_->steps = {};
  drop_removed();
  if (!attempts_->is_exhausted) evaluate_all(context_);
}

void Rounds::run(SimplifyReport& report) {
  if (faces_to_remove() == 0) {
    report.reason = StopReason::already_there;
    return;
  }
  context_.faces_to_remove = faces_to_remove();
  if (options_.observer != nullptr) options_.observer->expect(faces_to_remove() / 2 + 1);
  if (repeats()) repeat_last_attempt();
  if (guarding_ == Guarding::where_needed) {
    run_without_intersections();
  } else {
    run_rounds();
    run_to_the_end();
  }
  drop_removed();
  report.reason = reason();
  report.collapses = collapses_;
  report.rejected = rejected_;
  report.estimated_error = error_at_stop_ ? *error_at_stop_ : estimated_error();
  if (attempts_ != nullptr) {
    attempts_->steps = std::move(steps_);
    attempts_->rejected = rejected_;
    attempts_->refused = surface_.refused();
    attempts_->meets_bound = meets_bound_;
    attempts_->is_exhausted = faces_to_remove() > 0 && !error_at_stop_;
  }
}

/// Collapses in rounds, until a single region is left.
void Rounds::run_rounds() {
  for (std::uint32_t round = 0; !is_last_round(); ++round) {
    const std::size_t vertices = live_.size();
    run_regions(round);
    if ((vertices - live_.size()) * kVerticesPerLeastRound < vertices) break;
  }
}

/// Returns whether enough halvings remain that the order of current collapses does not matter.
bool Rounds::is_far() const {
  return faces_ / kFarFromTarget > options_.target_faces;
}

bool Rounds::is_last_round() const {
  return live_.size() < kFewVertices ||
         faces_to_remove() / 2 * kVerticesPerLastRemoved < live_.size();
}

/// Returns the budget of this round: the cost that covers the wanted fraction of the vertices.
/// Vertices without a legal edge are not counted, because no threshold would let them through.
Rounds::Share Rounds::share(std::span<const float> costs) const {
  std::vector<std::uint32_t> histogram(BucketQueue::kBuckets, 0);
  for (const float cost : costs)
    ++histogram[BucketQueue::bucket_of(cost)];
  const double wanted = std::min(kShareOfVertices * static_cast<double>(costs.size()),
                                 kShareOfTarget * 0.5 * faces_to_remove());
  double sum = 0.0;
  std::uint32_t bucket = 0;
  for (; bucket < BucketQueue::bucket_of(kNever) && sum < wanted; ++bucket)
    sum += histogram[bucket];
  return {BucketQueue::highest_below(bucket), std::min(1.0, kMostOfShare * wanted / sum)};
}

void Rounds::run_regions(std::uint32_t round) {
  constexpr std::uint32_t kBitsOfGrid = 7;
  constexpr float kGoldenRatio = 0.618034F;  // its multiples are spread evenly over [0, 1)
  context_.precision = is_far() ? CostPrecision::guess : CostPrecision::exact;
  const float shift = kGoldenRatio * static_cast<float>(round + 1);
  live_ =
      morton_order(surface_.mesh().positions(), live_,
                   {.bits = kBitsOfGrid, .shift = shift - std::floor(shift)}, options_.progress);
  const std::size_t apart = guarding_ == Guarding::where_needed ? move_guarded_last(round) : 0;
  const std::size_t rest = live_.size() - apart;
  const std::size_t cuts = (rest + kRegionVertices - 1) / kRegionVertices;
  const std::size_t count = cuts + (apart > 0 ? 1 : 0);
  const auto region = [&](std::size_t i) -> IndexRange {
    if (i == cuts) return {rest, live_.size()};
    return {rest * i / cuts, rest * (i + 1) / cuts};
  };
  // Costs are read several times, so copy them out of the much larger states.
  Array<float> costs(live_.size());
  parallel_for(count, 1, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      for (std::size_t k = region(i).begin; k < region(i).end; ++k) {
        VertexState& state = surface_.state(live_[k]);
        state.set_region(static_cast<std::uint32_t>(i));
        costs[k] = state.cost;
      }
    }
  });
  const Share share = this->share(costs);
  if (guarding_ == Guarding::everywhere) {
    space_->territory.claim(surface_);
    space_->has_regions = true;
  }
  std::vector<CollapseOutcome> outcomes(count);
  parallel_for(count, 1, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto [begin, end] = region(i);
      std::uint32_t cheap = 0;
      for (std::size_t k = begin; k < end; ++k)
        cheap += costs[k] <= share.cost ? 1U : 0U;
      Collapser collapser(context_,
                          {.region = static_cast<std::uint32_t>(i),
                           .cost = share.cost,
                           .tolerance = is_far() ? kToleranceFarFromTarget : kToleranceNearTarget,
                           .faces = 2 * static_cast<std::uint32_t>(share.part * cheap),
                           .valence = kUsualValence});
      outcomes[i] = translated(collapser.run(std::span(live_).subspan(begin, end - begin)));
    }
  });
  for (const CollapseOutcome& outcome : outcomes)
    note(outcome);
  drop_removed();
}

void Rounds::run_to_the_end() {
  context_.precision = CostPrecision::exact;
  if (space_ != nullptr) space_->has_regions = false;
  for (const Vertex v : live_)
    surface_.state(v).region = 0;
  if (std::isfinite(options_.stop_before_error)) {
    run_to_the_error();
  } else {
    collapse_to(options_.target_faces);
  }
  if (faces_to_remove() > 0 && !error_at_stop_) count_constrained();
}

/// Returns how many faces the next step keeps, given the current error.
std::uint32_t Rounds::next_step(double error) const {
  const double limit = options_.stop_before_error;
  const bool is_fine = collapses_ == 0 || faces_ <= kFewFaces || !(limit > 0.0);
  const double part =
      is_fine ? kFinestStep : std::clamp(kErrorMargin * error / limit, kCoarsestStep, kFinestStep);
  return std::max({static_cast<std::uint32_t>(part * faces_), options_.target_faces, 1U});
}

/// Simplifies in steps; undoes the last one if it exceeds the error.
void Rounds::run_to_the_error() {
  if (faces_ > options_.stop_below_faces) {
    collapse_to(std::max(options_.stop_below_faces, options_.target_faces));
  }
  double error = estimated_error();
  while (faces_to_remove() > 0) {
    drop_removed();
    const Checkpoint before(surface_.mesh(), live_);
    AttributeField* const attributes = policy_->attributes();
    const auto attributes_before =
        attributes != nullptr ? attributes->save() : AttributeField::Saved{};
    const auto counts = std::tuple(faces_, collapses_, paid_, rejected_);
    held_.emplace();
    collapse_to(next_step(error));
    if (faces_ == std::get<0>(counts)) return;
    const double next = estimated_error();
    if (faces_ < options_.stop_below_faces && next > options_.stop_before_error) {
      before.restore(surface_.mesh(), live_);
      if (attributes != nullptr) attributes->restore(attributes_before);
      std::tie(faces_, collapses_, paid_, rejected_) = counts;
      if (bound_) steps_.resize(collapses_);
      error_at_stop_ = error;
      return;
    }
    error = next;
    tell(*std::exchange(held_, std::nullopt));
  }
}

/// Frees the seams once fewer faces than `limit` are left, if `faces` are wanted.
void Rounds::free_seams_below(std::uint32_t limit, std::uint32_t faces) {
  if (faces >= limit || !surface_.can_free_seams()) return;
  if (faces_ > limit) collapse_region(limit);
  drop_removed();
  surface_.free_seams();
  evaluate_all(context_);
}

/// Collapses down to this many faces, or as few as legal.
void Rounds::collapse_to(std::uint32_t faces) {
  const std::uint32_t free_below = faces_before_ / kFacesPerFreeSeams;
  if (free_below > kTrackedFaces) free_seams_below(free_below, faces);
  if (!tracked_ && faces < kTrackedFaces && policy_->costs_are_errors()) {
    if (faces_ > kTrackedFaces) {
      collapse_region(kTrackedFaces);
      drop_removed();
    }
    tracked_.emplace(surface_, samples_);
    context_.samples = &*tracked_;
    if (bound_) bound_->distrust_estimates();
  }
  if (free_below <= kTrackedFaces) free_seams_below(free_below, faces);
  if (faces_ > faces) collapse_region(faces);
}

/// Same, in a single region.
void Rounds::collapse_region(std::uint32_t faces) {
  const std::uint32_t fresh = std::clamp(faces_before_ / kFacesPerFresh, kLeastFresh, kMostFresh);
  Collapser collapser(context_, {.faces = faces_ - faces,
                                 .fresh_after = faces_ > fresh ? faces_ - fresh : 0,
                                 .valence = kUsualValence});
  note(translated(collapser.run(live_)));
  // With an error bound, most edges are refused, and trying them again would take as long as all
  // the collapses. An edge whose surroundings changed was tried again already.
  while (faces_ > faces && (!bound_ || has_postponed_) &&
         try_refused_again(kLargestValence, faces)) {
  }
}

/// Edges that features forbid are never tried. If they are why the target was missed, the report
/// must say so.
void Rounds::count_constrained() {
  const Mesh& mesh = surface_.mesh();
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    if (surface_.is_removed(Mesh::face(h)) || !(h < mesh.twin(h))) continue;
    if (surface_.allowed_placement(h) != AllowedPlacement::nowhere) continue;
    if (!surface_.note_refused(h)) continue;  // it was before its ends were features
    const bool is_at_boundary =
        mesh.is_boundary(mesh.origin(h)) && mesh.is_boundary(mesh.target(h));
    const Rejection cause = is_at_boundary ? Rejection::boundary : Rejection::crease;
    ++rejected_[static_cast<std::size_t>(cause)];
  }
}

/// Re-evaluates all refused edges. Returns false if none could be collapsed.
bool Rounds::try_refused_again(std::size_t valence, std::uint32_t faces) {
  drop_removed();
  has_postponed_ = false;
  Collapser collapser(context_, {.faces = faces_ - faces, .fresh_after = 0, .valence = valence});
  const CollapseOutcome outcome = translated(collapser.run_refused(live_));
  note(outcome);
  return outcome.removed_faces > 0;
}

CollapseOutcome Rounds::translated(CollapseOutcome&& outcome) const {
  if (options_.observer != nullptr) translate_(outcome.records);
  return std::move(outcome);
}

void Rounds::tell(std::span<const CollapseRecord> records) {
  if (options_.observer == nullptr) return;
  if (untold_) {
    untold_->insert(untold_->end(), records.begin(), records.end());
  } else {
    options_.observer->collapsed(records);
  }
}

void Rounds::note(const CollapseOutcome& outcome) {
  if (held_) {
    held_->insert(held_->end(), outcome.records.begin(), outcome.records.end());
  } else {
    tell(outcome.records);
  }
  collapses_ += outcome.records.size();
  faces_ -= outcome.removed_faces;
  paid_ += outcome.paid;
  if (space_ != nullptr) {
    for (const CollapseRecord& record : outcome.records)
      context_.least_rank = std::max(context_.least_rank, static_cast<std::uint16_t>(record.rank));
  }
  for (std::size_t i = 0; i < kRejections.size(); ++i)
    rejected_[i] += outcome.rejected[i];
  meets_bound_ |= outcome.meets_bound;
  has_postponed_ |= outcome.has_postponed;
  steps_.insert(steps_.end(), outcome.steps.begin(), outcome.steps.end());
}

void Rounds::drop_removed() {
  std::erase_if(live_, [&](Vertex v) { return surface_.mesh().is_isolated(v); });
}

Array<Vertex> Rounds::vertices_left() const {
  Array<Vertex> left = live_;
  left.insert(left.end(), isolated_.begin(), isolated_.end());
  return left;
}

StopReason Rounds::reason() const {
  if (error_at_stop_) return StopReason::far_from_input;
  if (faces_to_remove() == 0) return StopReason::target_reached;
  return meets_bound_ ? StopReason::error_bound : StopReason::no_legal_collapse;
}

/// Returns the paid costs as a distance. Accurate if the errors of successive collapses are
/// independent; too low if a part shrinks step by step.
double Rounds::paid_error() const {
  const double area = surface_.area_before();
  return area > 0.0 ? std::sqrt(paid_ / (kTimesCounted * area)) : 0.0;
}

/// Returns the estimated error. The distance from input to result is measured at samples. The
/// distance from result to input is mostly the same, but equals the paid error where a part has
/// shrunk. The mean of both approximates it within a quarter.
double Rounds::estimated_error() const {
  const ErrorSamples::Measured measured = samples_.measure(surface_);
  const double paid = paid_error();
  const double doubt = kTrustInPaid * measured.uncertainty;
  const double forward = (std::sqrt(measured.mean_square) + doubt * paid) / (1.0 + doubt);
  const double backward = 0.5 * (forward + paid);
  return std::sqrt(0.5 * (forward * forward + backward * backward)) / double{scale_};
}

}  // namespace mesher::simplify
