#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/core/progress.h"

namespace mesher::io {

/// Equal items: the number of each item among the distinct ones, and the first of each kind.
struct Weld {
  Array<std::uint32_t> index;  ///< for each item, its number among the distinct items
  Array<std::uint32_t> first;  ///< for each distinct item, the lowest equal item
};

/// Finds bitwise equal items. An item is `words` consecutive 32-bit words.
///
/// Distinct items are numbered in the order of first appearance. Items are hashed, distributed to
/// buckets by hash, and sorted per bucket, which makes every input fast: O(n log n) time, in
/// parallel. Scratch: 12 bytes per item. Throws Cancelled. Pre: count < 2^32.
Weld weld(const std::uint32_t* items, std::size_t words, std::size_t count,
          Progress* progress = nullptr);

/// Finds equal positions, where 0 and -0 are equal.
Weld weld_positions(const Array<glm::vec3>& positions, Progress* progress = nullptr);

}  // namespace mesher::io
