#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/core/array.h"
#include "engine/simplify/observer.h"
#include "engine/simplify/reorder.h"
#include "engine/simplify/report.h"

namespace mesher::simplify {

/// What one run under an error bound leaves for the next, which repeats it with a tighter bound in
/// places. Ids are those of the run, which processes the input in `order`.
struct Attempts {
  std::optional<Reordered> order;  ///< the sorted input, not scaled; no value before the first run
  Array<float> shares;  ///< fraction of the bound that applies at each vertex; empty: all
  Array<CollapseStep>
      steps;  ///< of the last run, in scaled units; empty: there is nothing to repeat
  std::array<std::uint64_t, kRejections.size()> rejected{};  ///< refusals so far
  Array<std::uint8_t> refused;  ///< Surface::refused after the last run, so that none counts twice
  bool meets_bound = false;     ///< the last run refused an edge because of the bound
  bool is_exhausted = false;    ///< the last run ended because it had refused all remaining edges
};

}  // namespace mesher::simplify
