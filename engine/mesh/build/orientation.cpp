#include "engine/mesh/build/orientation.h"

#include <utility>

#include "engine/core/parallel.h"
#include "engine/mesh/mesh.h"

namespace mesher {
namespace {

constexpr std::size_t kHalfedgeGrain = std::size_t{1} << 16;
constexpr std::size_t kVisitsBetweenReports = std::size_t{1} << 16;

enum class Winding : std::uint8_t { unknown, keep, flip };

Winding opposite(Winding winding) {
  return winding == Winding::keep ? Winding::flip : Winding::keep;
}

}  // namespace

std::vector<std::uint32_t> faces_to_flip(const Array<Vertex>& origin, const EdgeMatching& matching,
                                         Progress* progress) {
  const auto face_count = static_cast<std::uint32_t>(origin.size() / 3);
  std::vector<Winding> winding(face_count, Winding::unknown);
  std::vector<std::uint32_t> component;  // its faces, in visiting order
  std::vector<std::uint32_t> flips;
  std::size_t visited = 0;
  for (std::uint32_t seed = 0; seed < face_count; ++seed) {
    if (winding[seed] != Winding::unknown) continue;
    component.assign(1, seed);
    winding[seed] = Winding::keep;
    std::size_t flipped = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const std::uint32_t f = component[i];
      if (visited++ % kVisitsBetweenReports == 0)
        report(progress, static_cast<float>(visited) / static_cast<float>(face_count));
      for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
        const Halfedge t = matching.twin[h];
        if (!t.is_valid()) continue;
        const std::uint32_t other = t.index() / 3;
        if (winding[other] != Winding::unknown) continue;
        const bool agrees = origin[h] != origin[t.index()];
        winding[other] = agrees ? winding[f] : opposite(winding[f]);
        flipped += winding[other] == Winding::flip ? 1 : 0;
        component.push_back(other);
      }
    }
    const Winding minority = 2 * flipped > component.size() ? Winding::keep : Winding::flip;
    for (const std::uint32_t f : component) {
      if (winding[f] == minority) flips.push_back(f);
    }
  }
  return flips;
}

void flip_faces(EdgeMatching& matching, const Array<Vertex>& origin,
                const std::vector<std::uint32_t>& flips) {
  std::vector<std::uint8_t> is_flipped(origin.size() / 3, 0);
  for (const std::uint32_t f : flips) {
    is_flipped[f] = 1;
    std::swap(matching.twin[3 * f], matching.twin[3 * f + 2]);
  }
  // The edge from corner 0 to 1 now runs from corner 2 to 0, and the other way round.
  const auto after = [&](std::uint32_t h) {
    return is_flipped[h / 3] != 0 ? h - h % 3 + (2 - h % 3) : h;
  };
  parallel_for(matching.twin.size(), kHalfedgeGrain, [&](IndexRange range) {
    for (std::size_t h = range.begin; h < range.end; ++h) {
      Halfedge& t = matching.twin[h];
      if (t.is_valid()) t = Halfedge(after(t.index()));
    }
  });
  // A face is only once in a crowd, so the order within a crowd stays.
  for (std::uint32_t& h : matching.crowded)
    h = after(h);
  matching.disagreeing_edges =
      parallel_sum<std::uint64_t>(matching.twin.size(), kHalfedgeGrain, [&](IndexRange range) {
        std::uint64_t count = 0;
        for (std::size_t h = range.begin; h < range.end; ++h) {
          const Halfedge t = matching.twin[h];
          count += t.is_valid() && h < t.index() && origin[h] == origin[t.index()] ? 1 : 0;
        }
        return count;
      });
}

}  // namespace mesher
