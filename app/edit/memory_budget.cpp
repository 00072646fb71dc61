#include "app/edit/memory_budget.h"

#include <fmt/format.h>

#include "engine/core/text.h"

namespace mesher::app {

std::string subdivision_refusal(const subdivide::SubdivisionSize& size, std::uint32_t levels,
                                const MemoryBudget& budget) {
  const std::string what = fmt::format("subdividing {} would make {} faces",
                                       count_text(levels, "time"), count_text(size.faces));
  if (!size.has_ids) {
    return what + " or more: too many for 32-bit indices";
  }
  const std::uint64_t needed = budget.held + size.peak_bytes + budget.beside +
                               (budget.copies - 1) * (size.result_bytes + budget.beside);
  if (needed <= budget.available / 5 * 4) return "";
  return fmt::format("{}, which needs {} of memory; the limit is four fifths of the {} that {}",
                     what, bytes_text(needed), bytes_text(budget.available),
                     budget.is_limited ? "--max-memory leaves" : "are free");
}

}  // namespace mesher::app
