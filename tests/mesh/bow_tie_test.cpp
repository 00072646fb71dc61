#include "engine/mesh/bow_tie.h"

#include <gtest/gtest.h>

namespace mesher {
namespace {

using Copies = Array<BowTieCopy>;

BowTieCopy copy(std::uint32_t v, std::uint32_t first) {
  return {Vertex(v), Vertex(first)};
}

TEST(BowTieCopies, NormalizeSortsAndNamesLowestVertexFirst) {
  Copies copies{copy(9, 4), copy(2, 7), copy(5, 4), copy(8, 7), copy(3, 4)};
  normalize(copies);
  EXPECT_EQ(copies, (Copies{copy(2, 2), copy(3, 3), copy(5, 3), copy(8, 2), copy(9, 3)}));
}

TEST(BowTieCopies, NormalizeDropsSingleCopies) {
  Copies copies{copy(9, 4), copy(2, 7), copy(5, 4)};
  normalize(copies);
  EXPECT_EQ(copies, (Copies{copy(5, 5), copy(9, 5)}));
  copies = {copy(1, 1)};
  normalize(copies);
  EXPECT_TRUE(copies.empty());
  normalize(copies);
  EXPECT_TRUE(copies.empty());
}

TEST(BowTieCopies, RenameMapsIdsAndDropsUnmappedVertices) {
  const Copies copies{copy(0, 0), copy(1, 1), copy(5, 0), copy(6, 1), copy(7, 0)};
  const auto reversed = [](Vertex v) { return Vertex(10 - v.index()); };
  EXPECT_EQ(renamed(copies, reversed),
            (Copies{copy(3, 3), copy(4, 4), copy(5, 3), copy(9, 4), copy(10, 3)}));
  const auto without_low = [](Vertex v) { return v.index() < 2 ? Vertex() : v; };
  EXPECT_EQ(renamed(copies, without_low), (Copies{copy(5, 5), copy(7, 5)}));
}

}  // namespace
}  // namespace mesher
