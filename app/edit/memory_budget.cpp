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
  return fmt::format("{} and need {} of memory; {} is free", what, bytes_text(needed),
                     bytes_text(budget.available));
}

}  // namespace mesher::app
