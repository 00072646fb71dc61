#include "engine/io/join.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mesh/ids.h"

namespace mesher::io {
namespace {

constexpr std::size_t kJoinGrain = std::size_t{1} << 14;
constexpr std::size_t kPositionsPerReport = std::size_t{1} << 16;

bool is_whole_position(const glm::vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Three words that are equal for positions that are to be joined, and for no others.
struct PositionKey {
  std::uint32_t words[3];
};

PositionKey key_of(const glm::vec3& p, std::size_t i) {
  if (!is_whole_position(p)) {
    constexpr std::uint32_t kNaN = 0x7FC00000U;
    return {{kNaN, static_cast<std::uint32_t>(i), 0}};
  }
  // Adding 0 turns -0 into 0 and changes nothing else.
  return {{std::bit_cast<std::uint32_t>(p.x + 0.0F), std::bit_cast<std::uint32_t>(p.y + 0.0F),
           std::bit_cast<std::uint32_t>(p.z + 0.0F)}};
}

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 32U)) * 0xD6E8FEB86659FD93U;
  return x ^ (x >> 32U);
}

std::uint32_t hash_of_key(const PositionKey& key) {
  std::uint64_t hash = 0x9E3779B97F4A7C15U;
  for (const std::uint32_t word : key.words)
    hash = mixed(hash ^ word);
  return static_cast<std::uint32_t>(hash);
}

/// A set of hashes with few false positives (B. Bloom, 1970): two bits for each hash, both in one
/// word, so that a test costs one access to memory. Of n hashes, about 0.6 % are false positives.
class HashSet {
 public:
  explicit HashSet(std::size_t hashes)
      : shift_(32U - static_cast<unsigned>(
                         std::clamp(static_cast<int>(std::bit_width(hashes / 2)), 4, 31))),
        words_(std::size_t{1} << (32U - shift_), 0) {}

  bool has(std::uint32_t hash) const { return (words_[hash >> shift_] & bits(hash)) == bits(hash); }
  void add(std::uint32_t hash) { words_[hash >> shift_] |= bits(hash); }

 private:
  static std::uint64_t bits(std::uint32_t hash) {
    const std::uint32_t product = hash * 0x9E3779B1U;
    return std::uint64_t{1} << (product >> 26U) | std::uint64_t{1} << (product >> 20U & 63U);
  }

  unsigned shift_;
  std::vector<std::uint64_t> words_;
};

/// Returns the positions that may equal another one: all that do, and few that do not. Empty if
/// none does.
///
/// Most files have no equal positions, and should not pay for sorting, as `weld` does.
std::vector<std::uint32_t> candidates(const Array<glm::vec3>& positions, Progress* progress) {
  const std::size_t count = positions.size();
  Array<std::uint32_t> hashes(count);
  parallel_chunks(count, kJoinGrain, progress, [&](std::size_t, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      hashes[i] = hash_of_key(key_of(positions[i], i));
  });
  HashSet seen(count);
  std::vector<std::uint32_t> repeats;
  for (const std::uint32_t hash : hashes) {
    if (seen.has(hash)) repeats.push_back(hash);
    seen.add(hash);
  }
  std::vector<std::uint32_t> found;
  if (repeats.empty()) return found;
  seen = HashSet(repeats.size());
  for (const std::uint32_t hash : repeats)
    seen.add(hash);
  check_cancelled(progress);
  for (std::size_t i = 0; i < count; ++i) {
    if (seen.has(hashes[i])) found.push_back(static_cast<std::uint32_t>(i));
  }
  return found;
}

/// Numbers the distinct items, given for each item the lowest one that it joins.
Weld numbered(Array<std::uint32_t>&& lowest) {
  Weld result;
  result.index = std::move(lowest);
  for (std::size_t i = 0; i < result.index.size(); ++i) {
    if (result.index[i] == i) {
      result.index[i] = static_cast<std::uint32_t>(result.first.size());
      result.first.push_back(static_cast<std::uint32_t>(i));
    } else {
      result.index[i] = result.index[result.index[i]];
    }
  }
  return result;
}

/// Returns whether many of the first positions are equal, as in STL, which has no shared vertices.
bool looks_repetitive(const Array<glm::vec3>& positions) {
  constexpr std::size_t kLooked = 1024;
  const std::size_t count = std::min(kLooked, positions.size());
  Array<PositionKey> keys(count);
  for (std::size_t i = 0; i < count; ++i)
    keys[i] = key_of(positions[i], i);
  const Weld equal = weld(reinterpret_cast<const std::uint32_t*>(keys.data()), 3, count, nullptr);
  return equal.first.size() < count - count / 4;
}

/// As `weld`, for all positions.
std::optional<Weld> sorted_positions(const Array<glm::vec3>& positions, Progress* progress) {
  Array<PositionKey> keys(positions.size());
  parallel_for(positions.size(), kJoinGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      keys[i] = key_of(positions[i], i);
  });
  return weld(reinterpret_cast<const std::uint32_t*>(keys.data()), 3, keys.size(), progress);
}

std::optional<Weld> equal_positions(const Array<glm::vec3>& positions, Progress* progress) {
  if (looks_repetitive(positions)) return sorted_positions(positions, progress);
  const std::vector<std::uint32_t> found = candidates(positions, progress);
  if (found.empty()) return std::nullopt;
  Array<PositionKey> keys(found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    keys[i] = key_of(positions[found[i]], found[i]);
  Weld equal = weld(reinterpret_cast<const std::uint32_t*>(keys.data()), 3, keys.size(), progress);
  if (equal.first.size() == found.size()) return std::nullopt;
  if (found.size() == positions.size()) return equal;
  Array<std::uint32_t> lowest(positions.size());
  for (std::size_t i = 0; i < lowest.size(); ++i)
    lowest[i] = static_cast<std::uint32_t>(i);
  for (std::size_t i = 0; i < found.size(); ++i)
    lowest[found[i]] = found[equal.first[equal.index[i]]];
  return numbered(std::move(lowest));
}

/// Vertices by the cell of a grid. The side of a cell is the distance, so a vertex within it lies
/// in the same or a neighboring cell, and few vertices, which are further apart than it, share a
/// cell.
class VertexGrid {
 public:
  VertexGrid(const Array<glm::vec3>& positions, double distance)
      : positions_(positions),
        distance_(distance),
        shift_(64U - static_cast<unsigned>(std::bit_width(positions.size() | 15U))),
        head_(std::size_t{1} << (64U - shift_), kNone),
        next_(positions.size(), kNone) {}

  /// Returns the nearest vertex within the distance, the earliest of equally near ones, or kNone.
  std::uint32_t nearest(const glm::vec3& p) const {
    std::uint32_t best = kNone;
    double best_square = distance_ * distance_;
    const glm::dvec3 cell = cell_of(p);
    for (int n = 0; n < 27; ++n) {
      const glm::dvec3 near = cell + glm::dvec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      for (std::uint32_t v = head_[slot(near)]; v != kNone; v = next_[v]) {
        const glm::dvec3 offset = glm::dvec3(positions_[v]) - glm::dvec3(p);
        const double square = glm::dot(offset, offset);
        if (square > best_square || (square == best_square && v > best)) continue;
        best = v;
        best_square = square;
      }
    }
    return best;
  }

  void add(std::uint32_t v) {
    std::uint32_t& head = head_[slot(cell_of(positions_[v]))];
    next_[v] = head;
    head = v;
  }

 private:
  glm::dvec3 cell_of(const glm::vec3& p) const { return glm::floor(glm::dvec3(p) / distance_); }
  std::size_t slot(const glm::dvec3& cell) const {
    std::uint64_t hash = 0x9E3779B97F4A7C15U;
    for (int i = 0; i < 3; ++i)
      hash = mixed(hash ^ std::bit_cast<std::uint64_t>(cell[i] + 0.0));
    return static_cast<std::size_t>(hash >> shift_);
  }

  const Array<glm::vec3>& positions_;
  double distance_;
  unsigned shift_;
  std::vector<std::uint32_t> head_;
  std::vector<std::uint32_t> next_;
};

std::optional<Weld> close_positions(const Array<glm::vec3>& positions, double distance,
                                    Progress* progress) {
  VertexGrid grid(positions, distance);
  Array<std::uint32_t> lowest(positions.size());
  bool joins_any = false;
  ordered_chunks(positions.size(), kPositionsPerReport, progress, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto v = static_cast<std::uint32_t>(i);
      lowest[i] = v;
      if (!is_whole_position(positions[i])) continue;
      const std::uint32_t near = grid.nearest(positions[i]);
      if (near == kNone) {
        grid.add(v);
      } else {
        lowest[i] = near;
        joins_any = true;
      }
    }
  });
  if (!joins_any) return std::nullopt;
  return numbered(std::move(lowest));
}

}  // namespace

std::optional<Weld> joined_positions(const Array<glm::vec3>& positions, double distance,
                                     BuildReport& report, Progress* progress) {
  // No two floats are closer than this.
  const bool is_exact = distance < static_cast<double>(std::numeric_limits<float>::denorm_min());
  std::optional<Weld> joined = is_exact ? equal_positions(positions, progress)
                                        : close_positions(positions, distance, progress);
  if (!joined) return joined;
  const std::uint64_t all = positions.size() - joined->first.size();
  std::uint64_t equal = is_exact ? all : 0;
  for (std::size_t i = 0; i < positions.size() && !is_exact; ++i) {
    const std::uint32_t first = joined->first[joined->index[i]];
    equal += first != i && positions[first] == positions[i] ? 1 : 0;
  }
  report[Repair::vertices_joined] += equal;
  report[Repair::close_vertices_joined] += all - equal;
  return joined;
}

void join_vertices(Soup& soup, double distance, Progress* progress) {
  const std::optional<Weld> joined =
      joined_positions(soup.positions, distance, soup.report, progress);
  if (!joined) return;
  Array<glm::vec3> positions(joined->first.size());
  parallel_for(positions.size(), kJoinGrain, [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v)
      positions[v] = soup.positions[joined->first[v]];
  });
  const std::size_t before = soup.positions.size();
  soup.positions = std::move(positions);
  parallel_for(soup.corners.size(), kJoinGrain, [&](IndexRange range) {
    for (std::size_t c = range.begin; c < range.end; ++c)
      soup.corners[c] = joined->index[soup.corners[c]];
  });
  const auto renumber = [&](std::uint32_t& v) {
    if (v < before) v = joined->index[v];
  };
  for (CreaseTag& tag : soup.creases) {
    renumber(tag.a);
    renumber(tag.b);
  }
  for (CornerTag& tag : soup.corner_tags)
    renumber(tag.v);
}

}  // namespace mesher::io
