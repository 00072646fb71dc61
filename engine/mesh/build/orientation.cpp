#include "engine/mesh/build/orientation.h"

#include "engine/mesh/mesh.h"

namespace mesher {
namespace {

enum class Turn : std::uint8_t { unknown, keep, flip };

Turn opposite(Turn turn) {
  return turn == Turn::keep ? Turn::flip : Turn::keep;
}

}  // namespace

std::vector<std::uint32_t> faces_to_flip(const Array<Vertex>& origin,
                                         const EdgeMatching& matching) {
  const auto face_count = static_cast<std::uint32_t>(origin.size() / 3);
  std::vector<Turn> turn(face_count, Turn::unknown);
  std::vector<std::uint32_t> component;  // its faces, in visiting order
  std::vector<std::uint32_t> flips;
  for (std::uint32_t seed = 0; seed < face_count; ++seed) {
    if (turn[seed] != Turn::unknown) continue;
    component.assign(1, seed);
    turn[seed] = Turn::keep;
    std::size_t flipped = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const std::uint32_t f = component[i];
      for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
        const Halfedge t = matching.twin[h];
        if (!t.is_valid()) continue;
        const std::uint32_t other = t.index() / 3;
        if (turn[other] != Turn::unknown) continue;
        const bool agrees = origin[h] != origin[t.index()];
        turn[other] = agrees ? turn[f] : opposite(turn[f]);
        flipped += turn[other] == Turn::flip ? 1 : 0;
        component.push_back(other);
      }
    }
    const Turn minority = 2 * flipped > component.size() ? Turn::keep : Turn::flip;
    for (const std::uint32_t f : component) {
      if (turn[f] == minority) flips.push_back(f);
    }
  }
  return flips;
}

}  // namespace mesher
