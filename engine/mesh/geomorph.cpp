#include "engine/mesh/geomorph.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/assert.h"
#include "engine/mesh/packed_normal.h"

namespace mesher {
namespace {

/// Calls `take` for each incomplete split of a vertex from `head` on, newest first, with whether
/// the vertex was its child, and with the fraction of the split that remains.
template <class Take>
void for_each_growing(std::uint32_t head, std::span<const SplitMorph> splits,
                      const GeomorphTime& time, Take&& take) {
  while (head != kNoHead && head >> 1U >= time.first_growing) {
    const std::uint32_t i = head >> 1U;
    MESHER_ASSERT(i < splits.size());
    take(splits[i], (head & 1U) != 0, 1.0F - growth(time, i));
    head = splits[i].previous;
  }
}

}  // namespace

GeomorphTime GeomorphTime::continuous(double time, double range) {
  MESHER_ASSERT(time >= 0.0 && range > 0.0);
  // At this time every split is complete, and differences from split numbers are still exact.
  constexpr double kMost = 2147483647.0;
  const double whole = std::floor(std::min(time, kMost));
  const double first = std::max(0.0, std::floor(std::min(time - range, kMost)));
  return {.first_growing = static_cast<std::uint32_t>(first),
          .whole = static_cast<std::int32_t>(whole),
          .fraction = static_cast<float>(std::min(time, kMost) - whole),
          .rate = static_cast<float>(1.0 / range),
          .fixed = 0.0F};
}

GeomorphTime GeomorphTime::between(std::uint32_t coarse, float alpha) {
  return {.first_growing = coarse, .whole = 0, .fraction = 0.0F, .rate = 0.0F, .fixed = alpha};
}

float growth(const GeomorphTime& time, std::uint32_t i) {
  if (i < time.first_growing) return 1.0F;
  const std::int32_t ahead = time.whole - static_cast<std::int32_t>(i);
  const float grown = time.fixed + time.rate * (static_cast<float>(ahead) + time.fraction);
  return std::clamp(grown, 0.0F, 1.0F);
}

glm::vec3 morphed_position(const glm::vec3& position, std::uint32_t head,
                           std::span<const SplitMorph> splits, const GeomorphTime& time) {
  glm::vec3 p = position;
  for_each_growing(head, splits, time, [&](const SplitMorph& split, bool is_child, float rest) {
    p -= rest * (is_child ? split.child_delta : split.parent_delta);
  });
  return p;
}

glm::vec3 morphed_normal(std::uint32_t normal, std::uint32_t head,
                         std::span<const SplitMorph> splits, const GeomorphTime& time) {
  const glm::vec3 full = decode_normal(normal);
  glm::vec3 n = full;
  for_each_growing(head, splits, time, [&](const SplitMorph& split, bool is_child, float rest) {
    const glm::vec3 after = decode_normal(is_child ? split.child_normal : split.parent_normal);
    n -= rest * (after - decode_normal(split.coarse_normal));
  });
  const float square = glm::dot(n, n);
  return square > 0.0F && n != full ? n / std::sqrt(square) : full;
}

AttributeValue morphed_value(const AttributeLayer& values, const WedgeMorph& morph,
                             std::size_t layer, Wedge w, const GeomorphTime& time) {
  AttributeValue morphed = load(values, w.index());
  const std::uint32_t first = morph.first_word[layer];
  if (first == 0) return morphed;
  for (std::uint32_t change = morph.heads[w.index()]; change != kNoHead;) {
    const auto words = morph.words.subspan(std::size_t{morph.stride} * change, morph.stride);
    if (words[0] < time.first_growing) break;
    const float rest = 1.0F - growth(time, words[0]);
    for (std::size_t k = 0; k < values.type().components; ++k)
      morphed[k] -= double{rest * std::bit_cast<float>(words[first + k])};
    change = words[1];
  }
  return morphed;
}

}  // namespace mesher
