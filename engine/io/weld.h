#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"

namespace mesher {

/// Equal items found: what each item became, and one of each kind.
struct Weld {
  Array<std::uint32_t> index;  ///< for each item, its number among the different ones
  Array<std::uint32_t> first;  ///< for each different one, the lowest item that equals it
};

/// Finds items that are bitwise equal. An item is `words` consecutive 32-bit words. The different
/// ones are numbered in the order of their first appearance. By sorting, so no input is slow: O(n
/// log n) time, in parallel; scratch 12 bytes an item. Pre: count < 2^32.
Weld weld(const std::uint32_t* items, std::size_t words, std::size_t count);

/// The same for positions, where 0 and -0 are equal.
Weld weld_positions(const Array<glm::vec3>& positions);

}  // namespace mesher
