#include "app/edit/memory_budget.h"

#include <cmath>

#include "app/document/words.h"

namespace mesher::app {

std::string bytes_text(std::uint64_t bytes) {
  constexpr const char* kUnits[] = {"B", "kB", "MB", "GB", "TB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  // A value that rounds to 1000 is shown as 1 of the next unit.
  while (value >= 999.5 && unit + 1 < std::size(kUnits)) {
    value /= 1000.0;
    ++unit;
  }
  const double rounded = value < 10.0 ? std::round(10.0 * value) / 10.0 : std::round(value);
  return short_number(rounded) + " " + kUnits[unit];
}

std::string subdivision_refusal(const subdivide::SubdivisionSize& size, std::uint32_t levels,
                                const MemoryBudget& budget) {
  const std::string what =
      "subdividing " + std::to_string(levels) + (levels == 1 ? " time" : " times") + " would make ";
  if (!size.has_ids) {
    return what + with_commas(size.faces) + " faces or more: too many for 32-bit indices";
  }
  const std::uint64_t needed = budget.held + size.peak_bytes + budget.beside +
                               (budget.copies - 1) * (size.result_bytes + budget.beside);
  if (needed <= budget.available / 5 * 4) return "";
  return what + with_commas(size.faces) + " faces and need " + bytes_text(needed) + " of memory; " +
         bytes_text(budget.available) + " is free";
}

}  // namespace mesher::app
