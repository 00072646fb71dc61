#include "engine/analysis/space_curve.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"

namespace mesher::analysis {
namespace {

constexpr std::size_t kCurveChunk = 1U << 13U;
constexpr std::uint32_t kBits = 10;  // per axis
constexpr std::uint32_t kDigitBits = 10;
constexpr std::uint32_t kDigits = 1U << kDigitBits;

struct Item {
  std::uint32_t key;
  std::uint32_t face;
};

/// The position of an octant on the curve, and the state of the curve inside it: a row of `kSteps`.
struct Step {
  std::uint8_t digit;
  std::uint8_t state;
};
constexpr std::size_t kMostStates = 24;
using Steps = std::array<std::array<Step, 8>, kMostStates>;

/// The rotation of a copy of the curve: bit i of the octant in the copy is bit `axis[i]` of the
/// given octant, inverted if that bit is set in `flip`.
struct Turn {
  std::array<std::uint8_t, 3> axis{0, 1, 2};
  std::uint8_t flip = 0;

  constexpr bool operator==(const Turn&) const = default;
  constexpr std::uint32_t apply(std::uint32_t octant) const {
    std::uint32_t turned = 0;
    for (std::uint32_t i = 0; i < 3; ++i)
      turned |= ((octant ^ flip) >> axis[i] & 1U) << i;
    return turned;
  }
};

/// Returns the index of a three-bit Gray code.
constexpr std::uint32_t gray_index(std::uint32_t code) {
  std::uint32_t index = code;
  index ^= index >> 1U;
  index ^= index >> 2U;
  return index & 7U;
}
constexpr std::uint32_t gray(std::uint32_t index) {
  return index ^ index >> 1U;
}

/// Returns the rotation of the curve within the octant visited as number `digit`, from its entry
/// `e` toward direction `d` (C. Hamilton, "Compact Hilbert indices", 2006).
constexpr Turn inner_turn(std::uint32_t digit) {
  const std::uint32_t even = digit == 0 ? 0 : (digit - 1) / 2 * 2;
  const std::uint32_t entry = digit == 0 ? 0 : gray(even);
  const auto trailing_ones = [](std::uint32_t x) {
    std::uint32_t ones = 0;
    for (; (x & 1U) != 0; x >>= 1U)
      ++ones;
    return ones;
  };
  const std::uint32_t direction = digit == 0       ? 0
                                  : digit % 2 == 0 ? trailing_ones(digit - 1) % 3
                                                   : trailing_ones(digit) % 3;
  Turn turn;
  turn.flip = static_cast<std::uint8_t>(entry);
  for (std::uint32_t i = 0; i < 3; ++i)
    turn.axis[i] = static_cast<std::uint8_t>((i + direction + 1) % 3);
  return turn;
}

/// Returns the rotation that applies `outer` first, then `inner`.
constexpr Turn combined(const Turn& outer, const Turn& inner) {
  Turn turn;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint8_t axis = outer.axis[inner.axis[i]];
    turn.axis[i] = axis;
    if ((inner.flip >> inner.axis[i] & 1U) != 0) turn.flip ^= static_cast<std::uint8_t>(1U << axis);
  }
  turn.flip ^= outer.flip;
  return turn;
}

/// Returns the curve as a state machine: one lookup per level instead of rotating coordinates.
constexpr Steps make_steps() {
  Steps steps{};
  std::array<Turn, kMostStates> turns{};
  std::size_t count = 1;
  for (std::size_t state = 0; state < count; ++state) {
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      const std::uint32_t digit = gray_index(turns[state].apply(octant));
      const Turn inside = combined(turns[state], inner_turn(digit));
      std::size_t next = 0;
      while (next < count && !(turns[next] == inside))
        ++next;
      if (next == count) turns[count++] = inside;
      steps[state][octant] = {static_cast<std::uint8_t>(digit), static_cast<std::uint8_t>(next)};
    }
  }
  return steps;
}

constexpr Steps kSteps = make_steps();

std::uint32_t hilbert_key(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint32_t key = 0;
  std::uint32_t state = 0;
  for (std::uint32_t bit = kBits; bit-- > 0;) {
    const std::uint32_t octant = (x >> bit & 1U) | (y >> bit & 1U) << 1U | (z >> bit & 1U) << 2U;
    const Step step = kSteps[state][octant];
    key = key << 3U | step.digit;
    state = step.state;
  }
  return key;
}

struct Extent {
  glm::vec3 min;
  glm::vec3 max;
};

/// Returns the extent of the vertices that faces use: an isolated vertex may be anywhere.
Extent extent(const Mesh& mesh) {
  const auto origins = mesh.origins();
  std::vector<Extent> parts(chunk_count(origins.size(), 4 * kCurveChunk));
  parallel_chunks(origins.size(), 4 * kCurveChunk, [&](std::size_t chunk, IndexRange range) {
    const glm::vec3& first = mesh.position(origins[range.begin]);
    Extent part{first, first};
    for (std::size_t i = range.begin; i < range.end; ++i) {
      part.min = glm::min(part.min, mesh.position(origins[i]));
      part.max = glm::max(part.max, mesh.position(origins[i]));
    }
    parts[chunk] = part;
  });
  Extent all = parts.front();
  for (const Extent& part : parts)
    all = {glm::min(all.min, part.min), glm::max(all.max, part.max)};
  return all;
}

/// Runs one pass of a radix sort.
void sort_by_digit(const Array<Item>& from, Array<Item>& to, std::uint32_t shift) {
  std::array<std::uint32_t, kDigits> start{};
  const auto digit = [&](const Item& item) { return item.key >> shift & (kDigits - 1); };
  for (const Item& item : from)
    ++start[digit(item)];
  std::uint32_t before = 0;
  for (std::uint32_t& s : start)
    before += std::exchange(s, before);
  for (const Item& item : from)
    to[start[digit(item)]++] = item;
}

}  // namespace

Array<std::uint32_t> faces_along_curve(const Mesh& mesh) {
  const std::size_t faces = mesh.face_count();
  if (faces == 0) return {};
  const Extent box = extent(mesh);
  // Halved, because the sum of three coordinates or the difference of two may overflow.
  const glm::vec3 size = 0.5F * box.max - 0.5F * box.min;
  const float longest = std::max({size.x, size.y, size.z});
  const float scale = longest > 0.0F ? static_cast<float>((1U << kBits) - 1U) / longest : 0.0F;
  const auto cell = [&](float a, float b, float c, float low) {
    const float center = (a * (1.0F / 6.0F) + b * (1.0F / 6.0F) + c * (1.0F / 6.0F)) - 0.5F * low;
    return static_cast<std::uint32_t>(
        std::clamp(center * scale, 0.0F, static_cast<float>((1U << kBits) - 1U)));
  };
  Array<Item> items(faces);
  parallel_for_each(faces, kCurveChunk, [&](std::uint32_t f) {
    const auto at = [&](std::uint32_t c) -> const glm::vec3& {
      return mesh.position(mesh.origin(Mesh::halfedge(Face(f), c)));
    };
    const glm::vec3& a = at(0);
    const glm::vec3& b = at(1);
    const glm::vec3& c = at(2);
    items[f] = {hilbert_key(cell(a.x, b.x, c.x, box.min.x), cell(a.y, b.y, c.y, box.min.y),
                            cell(a.z, b.z, c.z, box.min.z)),
                f};
  });
  Array<Item> sorted(faces);
  for (std::uint32_t shift = 0; shift < 3 * kBits; shift += kDigitBits) {
    sort_by_digit(items, sorted, shift);
    std::swap(items, sorted);
  }
  Array<std::uint32_t> order(faces);
  for (std::size_t i = 0; i < faces; ++i)
    order[i] = items[i].face;
  return order;
}

}  // namespace mesher::analysis
