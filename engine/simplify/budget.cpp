#include "engine/simplify/budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "engine/simplify/bucket_queue.h"
#include "engine/simplify/handy_scale.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/simplify.h"

namespace mesher::simplify {
namespace {

/// Lengths of a scene beyond these are not sensible, and their fourth powers stay finite.
constexpr double kLeastScale = 1e-30;
constexpr double kLargestScale = 1e30;

/// Counts collapses by rank, which takes less memory than recording them.
class RankCounter : public CollapseObserver {
 public:
  void collapsed(std::span<const CollapseRecord> records) override {
    for (const CollapseRecord& record : records) {
      CostStep& step = by_rank_[std::min(record.rank, CollapseRecord::kRanks - 1)];
      step.faces += record.twin.is_valid() ? 2 : 1;
      ++step.removals;
    }
  }

  CostCurve curve() const {
    CostCurve curve;
    for (std::uint32_t rank = 0; rank < by_rank_.size(); ++rank) {
      if (by_rank_[rank].removals == 0) continue;
      curve.push_back(by_rank_[rank]);
      const double cost = BucketQueue::highest_below(rank + 1);
      // The last ranks are infinite or no numbers.
      curve.back().cost = std::isfinite(cost) ? cost : double{std::numeric_limits<float>::max()};
    }
    return curve;
  }

 private:
  std::vector<CostStep> by_rank_ = std::vector<CostStep>(CollapseRecord::kRanks);
};

/// Returns the power of lengths that a cost is.
int dimension(CostPolicy policy) {
  if (policy == CostPolicy::random) return 0;
  const bool is_error = policy == CostPolicy::quadric || policy == CostPolicy::accumulated_quadric;
  return is_error ? 4 : 2;
}

/// Returns how many faces each removal of a step takes; 1 if they differ.
std::uint64_t faces_per_removal(const CostStep& step) {
  return step.faces % step.removals == 0 ? step.faces / step.removals : 1;
}

/// A queue over all items whose next removal is the cheapest.
class Distribution {
 public:
  explicit Distribution(std::span<const BudgetItem> items) : items_(items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      left_.push_back(items[i].faces);
      shown_ += items[i].weight * items[i].faces;
      push(i);
    }
  }

  std::vector<std::uint32_t> run(std::uint64_t faces) && {
    std::size_t last = 0;
    while (shown_ > faces && !next_.empty()) {
      last = std::get<1>(next_.top());
      next_.pop();
      take(last, shown_ - faces);
      push(last);
    }
    if (shown_ < faces) give_back(last, faces - shown_);
    return std::move(left_);
  }

 private:
  void push(std::size_t item) {
    at_.resize(items_.size(), 0);
    taken_.resize(items_.size(), 0);
    if (at_[item] < items_[item].curve.size())
      next_.emplace(items_[item].curve[at_[item]].cost, item);
  }

  /// Makes as many removals of the item's next step as are needed to remove `shown` faces.
  void take(std::size_t item, std::uint64_t shown) {
    const CostStep& step = items_[item].curve[at_[item]++];
    const std::uint64_t weight = items_[item].weight;
    const std::uint64_t faces = (shown + weight - 1) / weight;
    const std::uint64_t each = faces_per_removal(step);
    const std::uint64_t whole = (faces + each - 1) / each * each;
    taken_[item] =
        static_cast<std::uint32_t>(std::min<std::uint64_t>({whole, step.faces, left_[item]}));
    left_[item] -= taken_[item];
    shown_ -= weight * taken_[item];
  }

  /// Undoes the most expensive removals of the other items that fit into what the last removal of
  /// `last` took too much.
  void give_back(std::size_t last, std::uint64_t shown) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (i != last && taken_[i] > 0) order.emplace_back(-items_[i].curve[at_[i] - 1].cost, i);
    }
    std::ranges::sort(order);
    for (const auto& [cost, i] : order) {
      const std::uint64_t each = faces_per_removal(items_[i].curve[at_[i] - 1]);
      const std::uint64_t most = std::min<std::uint64_t>(shown / items_[i].weight, taken_[i]);
      const auto given = static_cast<std::uint32_t>(most / each * each);
      left_[i] += given;
      shown -= items_[i].weight * given;
    }
  }

  using Next = std::pair<double, std::size_t>;

  std::span<const BudgetItem> items_;
  std::vector<std::uint32_t> left_;   ///< faces of each item
  std::vector<std::size_t> at_;       ///< next step of each item
  std::vector<std::uint32_t> taken_;  ///< faces that the item's last step took
  std::uint64_t shown_ = 0;
  std::priority_queue<Next, std::vector<Next>, std::greater<>> next_;
};

}  // namespace

CostCurve cost_curve(const Mesh& mesh, const SimplifyOptions& options) {
  RankCounter counter;
  SimplifyOptions rules = options;
  rules.target_faces = 0;
  rules.max_error = std::numeric_limits<double>::infinity();
  rules.stop_before_error = std::numeric_limits<double>::infinity();
  rules.certifies = false;
  rules.no_intersections = false;
  rules.observer = &counter;
  static_cast<void>(simplify(Mesh(mesh), rules));
  CostCurve curve = counter.curve();
  scale_costs(curve, options.cost, 1.0 / double{handy_scale(mesh)});
  return curve;
}

std::uint64_t removable_faces(const CostCurve& curve) {
  std::uint64_t faces = 0;
  for (const CostStep& step : curve)
    faces += step.faces;
  return faces;
}

void limit_removals(CostCurve& curve, std::uint64_t faces) {
  std::size_t kept = 0;
  for (; kept < curve.size() && faces > 0; ++kept) {
    CostStep& step = curve[kept];
    if (step.faces > faces) {
      step.removals = static_cast<std::uint32_t>(
          std::max<std::uint64_t>(1, std::uint64_t{step.removals} * faces / step.faces));
      step.faces = static_cast<std::uint32_t>(faces);
    }
    faces -= step.faces;
  }
  curve.resize(kept);
}

void scale_costs(CostCurve& curve, CostPolicy policy, double scale) {
  const double factor = std::pow(std::clamp(scale, kLeastScale, kLargestScale), dimension(policy));
  for (CostStep& step : curve)
    step.cost *= factor;
}

std::vector<std::uint32_t> distribute(std::span<const BudgetItem> items, std::uint64_t faces) {
  return Distribution(items).run(faces);
}

}  // namespace mesher::simplify
