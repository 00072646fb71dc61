#include "engine/mesh/build/edge_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "engine/core/parallel.h"

namespace mesher {
namespace {

using Corners = std::vector<std::uint32_t>;

Array<Vertex> origins(const Corners& corners) {
  Array<Vertex> result;
  for (const std::uint32_t v : corners)
    result.push_back(Vertex(v));
  return result;
}

/// The expected result of match_edges, computed with a map of edges.
EdgeMatching by_map(const Corners& corners) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> first;
  std::set<std::uint32_t> coincident;
  EdgeMatching expected;
  for (std::uint32_t h = 0; h < corners.size(); ++h) {
    const std::uint32_t a = corners[h];
    const std::uint32_t b = corners[h - h % 3 + (h + 1) % 3];
    edges[std::minmax(a, b)].push_back(h);
    if (h % 3 != 0) continue;
    std::array<std::uint32_t, 3> face{corners[h], corners[h + 1], corners[h + 2]};
    std::sort(face.begin(), face.end());
    const auto [earlier, is_new] = first.try_emplace(face, h / 3);
    if (!is_new) coincident.insert({earlier->second, h / 3});
  }
  expected.coincident_faces.assign(coincident.begin(), coincident.end());
  expected.twin.assign(corners.size(), Halfedge{});
  for (const auto& [ends, halfedges] : edges) {
    if (halfedges.size() == 2) {
      expected.twin[halfedges[0]] = Halfedge(halfedges[1]);
      expected.twin[halfedges[1]] = Halfedge(halfedges[0]);
      if (corners[halfedges[0]] == corners[halfedges[1]]) ++expected.disagreeing_edges;
    }
    if (halfedges.size() <= 2) continue;
    expected.crowded.insert(expected.crowded.end(), halfedges.begin(), halfedges.end());
    expected.crowd_start.push_back(expected.crowded.size());
  }
  return expected;
}

void expect_as_by_map(const Corners& corners, std::uint32_t vertices) {
  const EdgeMatching matching = match_edges(origins(corners), vertices);
  const EdgeMatching expected = by_map(corners);
  EXPECT_EQ(matching.twin, expected.twin);
  EXPECT_EQ(matching.disagreeing_edges, expected.disagreeing_edges);
  EXPECT_EQ(matching.crowded, expected.crowded);
  EXPECT_EQ(matching.crowd_start, expected.crowd_start);
  EXPECT_EQ(matching.coincident_faces, expected.coincident_faces);
}

/// `n` faces around vertex 0, the lower end of the edges of 2 n half-edges. The rim is closed.
Corners wheel(std::uint32_t n) {
  Corners corners;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (const std::uint32_t v : {0U, 1 + i, 1 + (i + 1) % n})
      corners.push_back(v);
  }
  return corners;
}

TEST(EdgeMatching, WheelOfAnySizeClosesAroundItsHub) {
  for (std::uint32_t n = 3; n <= 40; ++n) {
    const Corners corners = wheel(n);
    expect_as_by_map(corners, n + 1);
    const EdgeMatching matching = match_edges(origins(corners), n + 1);
    EXPECT_TRUE(matching.twin[0].is_valid()) << n;
    EXPECT_FALSE(matching.twin[1].is_valid()) << n;  // a rim edge
  }
}

TEST(EdgeMatching, OpenFanHasTwoUnmatchedHalfEdges) {
  for (std::uint32_t n = 2; n <= 40; ++n) {
    Corners corners = wheel(n + 1);
    corners.resize(corners.size() - 3);
    expect_as_by_map(corners, n + 2);
  }
}

TEST(EdgeMatching, FlippedFaceDisagreesAtEachOfItsEdges) {
  for (std::uint32_t n = 3; n <= 20; ++n) {
    Corners corners = wheel(n);
    std::swap(corners[3], corners[4]);
    expect_as_by_map(corners, n + 1);
    EXPECT_EQ(match_edges(origins(corners), n + 1).disagreeing_edges, 2U) << n;
  }
}

TEST(EdgeMatching, FindsDuplicateFaceAmongAnyNumberOfOthers) {
  for (std::uint32_t n = 1; n <= 20; ++n) {
    Corners corners = wheel(n + 2);
    corners.resize(3 * n);
    // The duplicate is reversed and rotated. Two faces on the same edges are not a pair.
    for (const std::uint32_t v : {corners[2], corners[1], corners[0]})
      corners.push_back(v);
    expect_as_by_map(corners, n + 3);
    EXPECT_EQ(match_edges(origins(corners), n + 3).coincident_faces, (Corners{0, n})) << n;
  }
}

TEST(EdgeMatching, ThirdFaceMakesTheEdgeNonManifold) {
  for (std::uint32_t n = 3; n <= 20; ++n) {
    Corners corners = wheel(n);
    for (const std::uint32_t v : {1U, 0U, n + 1})
      corners.push_back(v);
    expect_as_by_map(corners, n + 2);
    EXPECT_EQ(match_edges(origins(corners), n + 2).crowd_count(), 1U) << n;
  }
}

Corners random_faces(std::uint32_t vertices, std::size_t faces, std::mt19937& random) {
  Corners corners;
  for (; faces > 0; --faces) {
    std::set<std::uint32_t> face;
    while (face.size() < 3)
      face.insert(static_cast<std::uint32_t>(random() % vertices));
    std::vector<std::uint32_t> order(face.begin(), face.end());
    std::shuffle(order.begin(), order.end(), random);
    corners.insert(corners.end(), order.begin(), order.end());
  }
  return corners;
}

TEST(EdgeMatching, AgreesWithMapOnRandomFaces) {
  std::mt19937 random(5);
  for (int round = 0; round < 2000; ++round) {
    const auto vertices = static_cast<std::uint32_t>(3 + random() % 20);
    expect_as_by_map(random_faces(vertices, random() % 60, random), vertices);
  }
}

TEST(EdgeMatching, AgreesWithMapOnDenseSoup) {
  std::mt19937 random(6);
  // Below and above the number of half-edges per vertex from which they are grouped.
  for (const std::size_t faces : {100U, 700U, 800U, 900U, 4000U}) {
    for (const std::uint32_t vertices : {20U, 50U, 100U})
      expect_as_by_map(random_faces(vertices, faces, random), vertices);
  }
}

TEST(EdgeMatching, DenseSoupIsTheSameForAnyThreadCount) {
  std::mt19937 random(7);
  const Array<Vertex> soup = origins(random_faces(200, 20'000, random));
  const auto with = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return match_edges(soup, 200);
  };
  const EdgeMatching one = with(1);
  const EdgeMatching three = with(3);
  EXPECT_EQ(one.twin, three.twin);
  EXPECT_EQ(one.crowded, three.crowded);
  EXPECT_EQ(one.coincident_faces, three.coincident_faces);
}

TEST(EdgeMatching, SameForAnyThreadCount) {
  constexpr std::uint32_t kWheels = 10'000;  // several chunks of vertices
  Corners corners;
  for (std::uint32_t i = 0; i < kWheels; ++i) {
    for (const std::uint32_t v : wheel(3 + i % 17))
      corners.push_back(20 * i + v);
  }
  const auto with = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return match_edges(origins(corners), 20 * kWheels).twin;
  };
  EXPECT_EQ(with(1), with(3));
}

}  // namespace
}  // namespace mesher
