#include "engine/mesh/build/orientation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace mesher {
namespace {

Array<Vertex> distinct_faces(std::uint32_t vertices, std::size_t faces, std::mt19937& random) {
  Array<Vertex> origin;
  std::set<std::set<std::uint32_t>> known;
  while (origin.size() < 3 * faces) {
    const std::set<std::uint32_t> face{static_cast<std::uint32_t>(random() % vertices),
                                       static_cast<std::uint32_t>(random() % vertices),
                                       static_cast<std::uint32_t>(random() % vertices)};
    if (face.size() < 3 || !known.insert(face).second) continue;
    for (const std::uint32_t v : face)
      origin.push_back(Vertex(v));
    if (random() % 2 == 0) std::swap(origin[origin.size() - 1], origin[origin.size() - 2]);
  }
  return origin;
}

void flip(Array<Vertex>& origin, const std::vector<std::uint32_t>& faces) {
  for (const std::uint32_t f : faces)
    std::swap(origin[3 * f + 1], origin[3 * f + 2]);
}

void expect_equal(const EdgeMatching& a, const EdgeMatching& b) {
  EXPECT_EQ(a.twin, b.twin);
  EXPECT_EQ(a.disagreeing_edges, b.disagreeing_edges);
  EXPECT_EQ(a.crowded, b.crowded);
  EXPECT_EQ(a.crowd_start, b.crowd_start);
  EXPECT_EQ(a.coincident_faces, b.coincident_faces);
}

TEST(Orientation, FlippedMatchingIsThatOfTheFlippedFaces) {
  std::mt19937 random(11);
  for (int round = 0; round < 500; ++round) {
    const auto vertices = static_cast<std::uint32_t>(7 + random() % 30);
    Array<Vertex> origin = distinct_faces(vertices, 1 + random() % 30, random);
    EdgeMatching matching = match_edges(origin, vertices);
    std::vector<std::uint32_t> flips;
    for (std::uint32_t f = 0; f < origin.size() / 3; ++f) {
      if (random() % 3 == 0) flips.push_back(f);
    }
    flip(origin, flips);
    flip_faces(matching, origin, flips);
    expect_equal(matching, match_edges(origin, vertices));
  }
}

TEST(Orientation, FewerFacesOfEachComponentAreFlipped) {
  // Three faces around vertex 0, the second one turned around; and a face by itself.
  Array<Vertex> origin;
  for (const std::uint32_t v : {0U, 1U, 2U, 0U, 3U, 2U, 0U, 3U, 4U, 5U, 6U, 7U})
    origin.push_back(Vertex(v));
  const EdgeMatching matching = match_edges(origin, 8);
  EXPECT_EQ(matching.disagreeing_edges, 2U);
  EXPECT_EQ(faces_to_flip(origin, matching, nullptr), std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace mesher
