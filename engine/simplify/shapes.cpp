#include "engine/simplify/shapes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/analysis/hausdorff.h"
#include "engine/core/progress.h"
#include "engine/mesh/parts.h"
#include "engine/mesh/statistics.h"
#include "engine/simplify/budget.h"
#include "engine/simplify/carry_attributes.h"
#include "engine/simplify/prune.h"
#include "engine/simplify/reorder.h"
#include "engine/simplify/simplify_model.h"

namespace mesher::simplify {
namespace {

/// Times of recording the costs, and of simplifying.
constexpr double kReduceWeights[] = {0.5, 0.5};

/// Numbers of faces that a shape may keep: of the rest, and of each set of cards.
struct ShapeTarget {
  std::uint32_t rest = 0;
  std::vector<std::uint32_t> sets;
  friend bool operator==(const ShapeTarget&, const ShapeTarget&) = default;

  std::uint32_t sum() const {
    std::uint32_t faces = rest;
    for (const std::uint32_t set : sets)
      faces += set;
    return faces;
  }
};

bool has_seam_marks(const Mesh& mesh) {
  return std::ranges::find(mesh.sharpnesses(), kSeamSharpness) != mesh.sharpnesses().end();
}

/// A shape with its loose cards, and what it costs to simplify it.
class Reducible {
 public:
  Reducible(const SceneShape& in, const ShapesOptions& options) : in_(in), options_(options) {
    options_.rules.max_error /= in.scale;
    options_.rules.stop_before_error /= in.scale;
    const bool may_thin = !options.keeps_cards && !std::isfinite(options.rules.max_error);
    if (may_thin) cards_ = find_cards(in.mesh, in.attributes);
  }

  const SceneShape& in() const { return in_; }
  std::uint32_t faces() const { return in_.mesh.face_count(); }
  bool has_cards() const { return !cards_.sets.empty(); }
  /// Returns whether an error ends the removal of cards.
  bool may_stop() const { return has_cards() && std::isfinite(options_.rules.stop_before_error); }
  bool has_several_items() const {
    return cards_.sets.size() > 1 || (has_cards() && cards_.rest_faces > 0);
  }
  ShapeTarget full() const {
    if (!has_cards()) return {faces(), {}};
    ShapeTarget target{cards_.rest_faces, {}};
    for (const CardSet& set : cards_.sets)
      target.sets.push_back(set.faces);
    return target;
  }

  /// Measures the costs, unless they are known. `across`: also across seams.
  void record(bool across, Progress* progress) {
    if (!curve_) {
      measure_cards(progress);
      Mesh rest = rest_mesh(true);
      has_lines_ = has_seam_marks(rest);
      SimplifyOptions rules = options_.rules;
      rules.progress = progress;
      rules.metric = metric();
      rules.crosses_seams = true;
      curve_ = rest.face_count() > 0 ? cost_curve(rest, rules) : CostCurve();
    }
    if (!across || !has_lines_ || std::exchange(is_across_, true)) return;
    SimplifyOptions rules = options_.rules;
    rules.progress = progress;
    CostCurve across_seams = cost_curve(rest_mesh(false), rules);
    // Collapses along seams are expensive once few are left; those across are not held up by them.
    if (removable_faces(across_seams) > removable_faces(*curve_)) *curve_ = std::move(across_seams);
  }

  bool is_recorded() const { return curve_.has_value(); }

  /// Limits the removals to those that leave this number of faces of the rest.
  void limit(std::uint32_t rest) {
    limit_removals(*curve_, full().rest - std::min(full().rest, rest));
  }

  /// Appends the items of this shape: the rest, and each set of cards. Pre: they are recorded.
  void add_items(std::vector<BudgetItem>& items) const {
    const ShapeTarget all = full();
    const auto add = [&](std::uint32_t faces, CostCurve&& curve, CostPolicy policy) {
      scale_costs(curve, policy, in_.scale);
      items.push_back({faces, std::max<std::uint64_t>(in_.weight, 1), std::move(curve)});
    };
    add(all.rest, CostCurve(*curve_), options_.rules.cost);
    for (std::size_t set = 0; set < thinning_.size(); ++set) {
      add(all.sets[set], thinning_[set].curve(options_.rules.stop_before_error),
          CostPolicy::quadric);
    }
  }

  ShapeTarget take_target(std::span<const std::uint32_t>& counts) const {
    ShapeTarget target{counts.front(), {}};
    target.sets.assign(counts.begin() + 1,
                       counts.begin() + 1 + static_cast<std::ptrdiff_t>(cards_.sets.size()));
    counts = counts.subspan(1 + cards_.sets.size());
    return target;
  }

  ReducedShape reduce(const ShapeTarget& target, Progress* progress) {
    SimplifyOptions rules = options_.rules;
    rules.progress = progress;
    rules.target_faces = target.rest;
    if (has_cards()) return reduce_with_cards(target, rules);
    auto [simplified, attributes, crosses_seams] =
        simplify_model(Mesh(in_.mesh), in_.attributes, rules, options_.prunes);
    return {
        {std::move(simplified.mesh), std::move(attributes)}, simplified.report, crosses_seams, {}};
  }

 private:
  void measure_cards(Progress* progress) {
    if (!thinning_.empty()) return;
    for (std::uint32_t set = 0; set < cards_.sets.size(); ++set)
      thinning_.emplace_back(in_.mesh, cards_, set, progress);
  }

  bool is_rest(Face f) const {
    return !has_cards() || cards_.set_of_face[f.index()] == LooseCards::kRest;
  }

  /// Returns the faces that `keeps` accepts, with their vertices. Isolated vertices are of the
  /// rest.
  template <class Keeps>
  KeptIds select(bool isolated, const Keeps& keeps) const {
    KeptIds kept;
    for (std::uint32_t v = 0; v < in_.mesh.vertex_count(); ++v) {
      const Halfedge h = in_.mesh.outgoing(Vertex(v));
      if (h.is_valid() ? keeps(Mesh::face(h)) : isolated) kept.vertices.emplace_back(v);
    }
    for (std::uint32_t f = 0; f < in_.mesh.face_count(); ++f) {
      if (keeps(Face(f))) kept.faces.emplace_back(f);
    }
    return kept;
  }

  Mesh rest_mesh(bool marks) const {
    Mesh mesh = in_.mesh;
    if (marks) mark_seams(mesh, in_.attributes);
    if (!has_cards()) return mesh;
    return compact(mesh, select(true, [&](Face f) { return is_rest(f); }));
  }

  /// Returns the metric of the rest, or null if no attribute counts.
  const AttributeMetric* metric() {
    if (!metric_) {
      metric_ = attribute_metric(in_.mesh, in_.attributes, options_.rules.weights());
      if (has_cards() && metric_->size > 0) {
        metric_ = of_faces(*metric_, select(true, [&](Face f) { return is_rest(f); }).faces);
      }
    }
    return metric_->size > 0 ? &*metric_ : nullptr;
  }

  Simplified simplify_rest(bool marks, SimplifyOptions rules) {
    // Across seams, the sides have no common values.
    rules.metric = marks ? metric() : nullptr;
    rules.crosses_seams = rules.target_faces > 0;
    return options_.prunes ? simplify_pruned(rest_mesh(marks), rules)
                           : simplify(rest_mesh(marks), rules);
  }

  /// As simplify_model, for the rest.
  Simplified simplify_rest(const SimplifyOptions& rules, bool& crosses_seams) {
    Simplified along = simplify_rest(true, rules);
    crosses_seams = along.corners.crosses_seams;
    const bool is_stuck = along.report.reason == StopReason::no_legal_collapse &&
                          along.report.faces_reached > rules.target_faces;
    if (!is_stuck || !has_seam_marks(rest_mesh(true))) return along;
    Simplified across = simplify_rest(false, rules);
    if (across.report.faces_reached >= along.report.faces_reached) return along;
    crosses_seams = true;
    return across;
  }

  ReducedShape reduce_with_cards(const ShapeTarget& target, SimplifyOptions rules) {
    measure_cards(rules.progress);
    const bool certifies = std::exchange(rules.certifies, false);
    ReducedShape result;
    Simplified rest;
    rest.report.reason = StopReason::already_there;
    if (cards_.rest_faces > 0) rest = simplify_rest(rules, result.crosses_seams);
    result.report = rest.report;
    std::vector<std::uint32_t> left;
    std::vector<double> enlargement;
    for (std::size_t set = 0; set < thinning_.size(); ++set) {
      left.push_back(thinning_[set].cards_for(target.sets[set]));
      enlargement.push_back(thinning_[set].enlargement(left.back()));
    }
    std::vector<std::vector<bool>> is_left;
    for (std::size_t set = 0; set < left.size(); ++set) {
      const CardSet& all = cards_.sets[set];
      is_left.emplace_back(all.cards.size(), false);
      for (std::uint32_t i = 0; i < left[set]; ++i)
        is_left.back()[all.order[i]] = true;
      result.cards.cards += static_cast<std::uint32_t>(all.cards.size());
      result.cards.removed += static_cast<std::uint32_t>(all.cards.size()) - left[set];
      result.cards.enlarged = std::max(result.cards.enlarged, enlargement[set]);
    }
    put_together(rest, is_left, enlargement, rules.progress, result.shape);
    finish_report(target, left, certifies, result);
    return result;
  }

  /// Joins the rest with the cards that are left.
  void put_together(Simplified& rest, const std::vector<std::vector<bool>>& is_left,
                    std::span<const double> enlargement, Progress* progress, Shape& result) {
    Array<Face> source;
    const KeptIds of_rest = select(true, [&](Face f) { return is_rest(f); });
    for (const Face f : rest.face_source)
      source.push_back(of_rest.faces[f.index()]);
    const KeptIds of_cards = select(false, [&](Face f) {
      return !is_rest(f) && is_left[cards_.set_of_face[f.index()]][cards_.card_of_face[f.index()]];
    });
    source.insert(source.end(), of_cards.faces.begin(), of_cards.faces.end());
    unmark_seams(rest.mesh);
    const std::size_t rest_faces = rest.face_source.size();
    rest.face_source.assign(source.begin(),
                            source.begin() + static_cast<std::ptrdiff_t>(rest_faces));
    const Attributed input{in_.mesh, in_.attributes};
    std::vector<Shape> both(2);
    both[0].attributes = metric() != nullptr
                             ? carry_attributes(input, rest, *metric(), progress)
                             : carry_attributes(input, rest.mesh, rest.face_source, progress);
    both[0].mesh = std::move(rest.mesh);
    both[1].mesh = compact(in_.mesh, of_cards);
    // While the cards are where they were, so that their values stay bit for bit.
    both[1].attributes = carry_attributes(input, both[1].mesh, of_cards.faces, progress);
    result = joined(std::move(both));
    // Both have the groups of the input.
    const auto groups = static_cast<std::uint32_t>(in_.attributes.groups.size());
    for (std::uint32_t& group : result.attributes.group)
      group = groups > 0 ? group % groups : 0;
    if (groups == 0) result.attributes.group = {};
    result.attributes.groups = in_.attributes.groups;
    enlarge_cards(result.mesh, source, cards_, enlargement);
  }

  void finish_report(const ShapeTarget& target, std::span<const std::uint32_t> left, bool certifies,
                     ReducedShape& result) {
    SimplifyReport& report = result.report;
    report.faces_before = in_.mesh.face_count();
    report.vertices_before = in_.mesh.vertex_count();
    report.faces_asked = target.sum();
    report.faces_reached = result.shape.mesh.face_count();
    report.vertices_reached = result.shape.mesh.vertex_count();
    if (report.reason == StopReason::already_there && result.cards.removed > 0)
      report.reason = StopReason::target_reached;
    const double area = statistics(in_.mesh).area;
    double area_of_cards = 0.0;
    double squares = 0.0;
    for (std::size_t set = 0; set < left.size(); ++set) {
      const double error = thinning_[set].error(left[set]);
      squares += cards_.sets[set].area * error * error;
      area_of_cards += cards_.sets[set].area;
    }
    const double area_of_rest = std::max(area - area_of_cards, 0.0);
    const auto with_cards = [&](double error) {
      return area > 0.0 ? std::sqrt((area_of_rest * error * error + squares) / area) : error;
    };
    report.estimated_error = with_cards(report.estimated_error);
    report.error_unpruned = with_cards(report.error_unpruned);
    if (!certifies || report.faces_reached == 0) return;
    const auto start = std::chrono::steady_clock::now();
    report.certified_bound =
        analysis::hausdorff_bounds(in_.mesh, result.shape.mesh,
                                   {.ratio = bound_ratio(in_.mesh.face_count())})
            .two_sided()
            .upper;
    report.seconds.measure +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  SceneShape in_;
  std::optional<AttributeMetric> metric_;
  ShapesOptions options_;  ///< lengths in units of the mesh
  LooseCards cards_;
  std::vector<CardThinning> thinning_;  ///< by set, once measured
  std::optional<CostCurve> curve_;      ///< of the rest, in units of the mesh
  bool has_lines_ = false;
  bool is_across_ = false;
};

}  // namespace

class ShapesReducer::Impl {
 public:
  Impl(const std::vector<SceneShape>& shapes, const ShapesOptions& options)
      : per_shape_(options.per_shape), prunes_(options.prunes) {
    shapes_.reserve(shapes.size());
    for (const SceneShape& shape : shapes) {
      shapes_.emplace_back(shape, options);
      shown_ += shape.weight * shape.mesh.face_count();
    }
  }

  std::vector<ReducedShape> reduce(std::uint64_t faces, Progress* progress) {
    Stages stages(progress, kReduceWeights);
    stages.next();
    std::vector<ShapeTarget> targets = find_targets(faces, progress);
    stages.next();
    std::vector<ReducedShape> results(shapes_.size());
    run(targets, {}, results, progress);
    for (int repeat = 0; repeat < kMostRepeats && is_missed(results, faces); ++repeat) {
      if (prunes_ || !limit_stuck(targets, results)) break;
      const std::vector<ShapeTarget> before = std::exchange(targets, find_targets(faces, nullptr));
      run(targets, before, results, nullptr);
    }
    return results;
  }

 private:
  /// Shapes that share a target.
  using Group = std::vector<std::size_t>;

  std::vector<ShapeTarget> find_targets(std::uint64_t faces, Progress* progress) {
    std::vector<ShapeTarget> targets;
    for (const Reducible& shape : shapes_)
      targets.push_back(shape.full());
    if (faces == 0) {
      for (ShapeTarget& target : targets)
        target.rest = 0;
      return targets;
    }
    Group together;
    std::vector<std::pair<Group, std::uint64_t>> groups;
    const double ratio = std::min(1.0, double(faces) / std::max(1.0, double(shown_)));
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      if (!per_shape_ && shapes_[i].in().weight > 0) {
        together.push_back(i);
        continue;
      }
      const std::uint64_t weight = std::max<std::uint64_t>(shapes_[i].in().weight, 1);
      const auto own = static_cast<std::uint64_t>(std::llround(ratio * shapes_[i].faces()));
      groups.push_back({{i}, weight * std::max<std::uint64_t>(own, 1)});
    }
    if (!together.empty()) groups.emplace_back(std::move(together), faces);
    for (const auto& [group, target] : groups)
      set_targets(group, target, targets, progress);
    return targets;
  }

  void set_targets(const Group& group, std::uint64_t faces, std::vector<ShapeTarget>& targets,
                   Progress* progress) {
    Reducible& first = shapes_[group.front()];
    if (group.size() == 1 && !first.has_several_items() && !first.may_stop()) {
      const std::uint64_t weight = std::max<std::uint64_t>(first.in().weight, 1);
      const auto own =
          static_cast<std::uint32_t>(std::clamp<std::uint64_t>(faces / weight, 1, first.faces()));
      ShapeTarget& target = targets[group.front()];
      (target.sets.empty() ? target.rest : target.sets.front()) = own;
      return;
    }
    record(group, false, progress);
    std::vector<BudgetItem> items = items_of(group);
    if (fewest(items) > faces) {
      record(group, true, nullptr);
      items = items_of(group);
    }
    const std::vector<std::uint32_t> counts = distribute(items, faces);
    std::span<const std::uint32_t> left = counts;
    for (const std::size_t i : group)
      targets[i] = shapes_[i].take_target(left);
    if (!prunes_ || fewest(items) <= faces) return;
    // Collapses alone do not get there. Parts are removed where fewer faces are asked for.
    const double ratio = double(faces) / double(most(items));
    for (const std::size_t i : group) {
      const auto share = static_cast<std::uint32_t>(std::llround(ratio * shapes_[i].full().rest));
      targets[i].rest = std::max(1U, share);
    }
  }

  void record(const Group& group, bool across, Progress* progress) {
    std::vector<double> sizes;
    for (const std::size_t i : group)
      sizes.push_back(1.0 + shapes_[i].faces());
    Stages stages(progress, sizes);
    for (const std::size_t i : group) {
      stages.next("measuring costs");
      shapes_[i].record(across, progress);
    }
  }

  std::vector<BudgetItem> items_of(const Group& group) const {
    std::vector<BudgetItem> items;
    for (const std::size_t i : group)
      shapes_[i].add_items(items);
    return items;
  }

  static std::uint64_t most(std::span<const BudgetItem> items) {
    std::uint64_t faces = 0;
    for (const BudgetItem& item : items)
      faces += item.weight * item.faces;
    return faces;
  }

  static std::uint64_t fewest(std::span<const BudgetItem> items) {
    std::uint64_t faces = 0;
    for (const BudgetItem& item : items)
      faces += item.weight * (item.faces - removable_faces(item.curve));
    return faces;
  }

  /// Simplifies the shapes whose targets changed.
  void run(const std::vector<ShapeTarget>& targets, const std::vector<ShapeTarget>& before,
           std::vector<ReducedShape>& results, Progress* progress) {
    std::vector<double> sizes;
    for (const Reducible& shape : shapes_)
      sizes.push_back(1.0 + shape.faces());
    Stages stages(progress, sizes);
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      stages.next("simplifying");
      if (!before.empty() && before[i] == targets[i]) continue;
      results[i] = shapes_[i].reduce(targets[i], progress);
    }
  }

  /// Returns whether more faces are shown than were asked for.
  bool is_missed(const std::vector<ReducedShape>& results, std::uint64_t faces) const {
    if (faces == 0 || per_shape_) return false;
    std::uint64_t shown = 0;
    for (std::size_t i = 0; i < results.size(); ++i)
      shown += shapes_[i].in().weight * results[i].shape.mesh.face_count();
    return shown > faces;
  }

  /// Notes which shapes cannot get as small as they should. Returns whether there are any.
  bool limit_stuck(const std::vector<ShapeTarget>& targets,
                   const std::vector<ReducedShape>& results) {
    bool is_any = false;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const SimplifyReport& report = results[i].report;
      const std::uint32_t asked = targets[i].sum();
      const bool is_stuck =
          report.reason == StopReason::no_legal_collapse && report.faces_reached > asked;
      if (!is_stuck || !shapes_[i].is_recorded()) continue;
      shapes_[i].limit(targets[i].rest + report.faces_reached - asked);
      is_any = true;
    }
    return is_any;
  }

  bool per_shape_;
  bool prunes_;
  std::vector<Reducible> shapes_;
  std::uint64_t shown_ = 0;
};

ShapesReducer::ShapesReducer(const std::vector<SceneShape>& shapes, const ShapesOptions& options)
    : impl_(std::make_unique<Impl>(shapes, options)) {}

ShapesReducer::~ShapesReducer() = default;

std::vector<ReducedShape> ShapesReducer::reduce(std::uint64_t faces, Progress* progress) {
  return impl_->reduce(faces, progress);
}

}  // namespace mesher::simplify
