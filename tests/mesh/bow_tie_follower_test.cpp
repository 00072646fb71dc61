#include "engine/mesh/bow_tie_follower.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using Copies = Array<BowTieCopy>;

/// Three cubes that touch at one vertex: vertex 0 has the copies 22 and 23.
Mesh three_cubes() {
  return built(bow_tie({cube(), cube(), cube()})).mesh;
}

constexpr glm::vec3 kMeetingPoint{0.0F};

BowTieCopy copy(std::uint32_t v, std::uint32_t first) {
  return {Vertex(v), Vertex(first)};
}

TEST(BowTieFollower, StartsWithTheCopiesOfTheMesh) {
  const BowTieFollower follower(three_cubes());
  EXPECT_FALSE(follower.is_empty());
  EXPECT_EQ(follower.after(), (Copies{copy(0, 0), copy(22, 0), copy(23, 0)}));
  EXPECT_EQ(follower.before(), follower.after());
  EXPECT_TRUE(BowTieFollower(built(cube()).mesh).is_empty());
}

TEST(BowTieFollower, MergedCopyKeepsItsEntryInTheRemainingVertex) {
  BowTieFollower follower(three_cubes());
  follower.merge(Vertex(0), Vertex(6), kMeetingPoint);
  follower.merge(Vertex(6), Vertex(5), kMeetingPoint);
  follower.merge(Vertex(9), Vertex(22), kMeetingPoint);
  follower.merge(Vertex(14), Vertex(15), {1, 2, 3});
  EXPECT_EQ(follower.after(), (Copies{copy(5, 5), copy(22, 5), copy(23, 5)}));
  EXPECT_EQ(follower.before(), (Copies{copy(0, 0), copy(22, 0), copy(23, 0)}));
}

TEST(BowTieFollower, MovedCopyIsRemoved) {
  BowTieFollower follower(three_cubes());
  follower.merge(Vertex(9), Vertex(22), {0, 0, 1});
  EXPECT_EQ(follower.after(), (Copies{copy(0, 0), copy(23, 0)}));
  EXPECT_EQ(follower.before(), (Copies{copy(0, 0), copy(23, 0)}));
  // Moving the vertex back to the meeting point does not restore its entry.
  follower.merge(Vertex(10), Vertex(22), kMeetingPoint);
  EXPECT_EQ(follower.after(), (Copies{copy(0, 0), copy(23, 0)}));
  follower.merge(Vertex(0), Vertex(6), {0, 0, 1});
  EXPECT_TRUE(follower.after().empty());
  EXPECT_TRUE(follower.before().empty());
}

}  // namespace
}  // namespace mesher::test
