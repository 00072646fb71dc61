#include "engine/analysis/triangle_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/analysis/predicates.h"

namespace mesher::test {
namespace {

using Point = glm::dvec3;

const analysis::ExactTriangle kFlat{Point(0, 0, 0), Point(4, 0, 0), Point(0, 4, 0)};

/// Checks that the result does not depend on the order of corners, triangles or axes.
bool agree(const analysis::ExactTriangle& first, const analysis::ExactTriangle& second) {
  const bool expected = analysis::do_intersect(first, second);
  const auto check = [&](analysis::ExactTriangle a, analysis::ExactTriangle b) {
    std::array<std::size_t, 3> i{0, 1, 2};
    do {
      std::array<std::size_t, 3> k{0, 1, 2};
      do {
        const analysis::ExactTriangle p{a[i[0]], a[i[1]], a[i[2]]};
        const analysis::ExactTriangle q{b[k[0]], b[k[1]], b[k[2]]};
        EXPECT_EQ(analysis::do_intersect(p, q), expected);
        EXPECT_EQ(analysis::do_intersect(q, p), expected);
      } while (std::next_permutation(k.begin(), k.end()));
    } while (std::next_permutation(i.begin(), i.end()));
  };
  const auto turned = [](analysis::ExactTriangle t) {
    for (Point& p : t)
      p = {p.y, p.z, p.x};
    return t;
  };
  check(first, second);
  check(turned(first), turned(second));
  check(turned(turned(first)), turned(turned(second)));
  return expected;
}

bool meets_flat(const Point& a, const Point& b, const Point& c) {
  return agree(kFlat, {a, b, c});
}

TEST(TrianglePair, Crossing) {
  EXPECT_TRUE(meets_flat({1, 1, -1}, {1, 1, 1}, {9, 9, 1}));
  EXPECT_TRUE(meets_flat({-1, 1, -1}, {-1, 1, 1}, {9, 1, 0.5}));
}

TEST(TrianglePair, Disjoint) {
  EXPECT_FALSE(meets_flat({1, 1, 1}, {2, 1, 1}, {1, 2, 3}));
  EXPECT_FALSE(meets_flat({5, 5, -1}, {5, 5, 1}, {9, 9, 1}));
  // Both triangles reach the plane of the other, but side by side on the line where the planes
  // meet.
  EXPECT_FALSE(meets_flat({5, 1, -1}, {5, 1, 1}, {9, 1, 0.5}));
  EXPECT_FALSE(meets_flat({-1, 1, -1}, {-1, 1, 1}, {-9, 1, 0.5}));
}

TEST(TrianglePair, Touching) {
  EXPECT_TRUE(meets_flat({1, 1, 0}, {1, 2, 1}, {2, 1, 1})) << "corner inside";
  EXPECT_TRUE(meets_flat({2, 0, 0}, {2, -1, 1}, {3, -1, 1})) << "corner on a side";
  EXPECT_TRUE(meets_flat({-1, -1, 0}, {1, 1, 0}, {0, 0, 5})) << "side through a corner";
  EXPECT_TRUE(meets_flat({2, -1, -1}, {2, 1, 1}, {9, -9, 0})) << "sides cross";
  EXPECT_TRUE(meets_flat({1, 0, 0}, {2, 0, 0}, {1, 0, 1})) << "side within a side";
  EXPECT_TRUE(meets_flat({-1, 0, 0}, {9, 0, 0}, {1, 0, 1})) << "side within a longer side";
  EXPECT_FALSE(meets_flat({2, -0x1p-20, 0}, {2, -1, 1}, {3, -1, 1})) << "just outside";
}

TEST(TrianglePair, Coplanar) {
  EXPECT_TRUE(meets_flat({1, 1, 0}, {2, 1, 0}, {1, 2, 0})) << "inside";
  EXPECT_TRUE(meets_flat({-9, -9, 0}, {30, -9, 0}, {-9, 30, 0})) << "around";
  EXPECT_TRUE(meets_flat({-1, 1, 0}, {9, 1, 0}, {9, 2, 0})) << "across";
  EXPECT_TRUE(meets_flat({2, 2, 0}, {5, 5, 0}, {2, 5, 0})) << "corner on a side";
  EXPECT_FALSE(meets_flat({3, 3, 0}, {5, 5, 0}, {2, 5, 0}));
  EXPECT_FALSE(meets_flat({-1, 0, 0}, {-1, 5, 0}, {-5, 0, 0}));
}

TEST(TrianglePair, SharedCorner) {
  EXPECT_FALSE(meets_flat({0, 0, 0}, {-1, 0, 0}, {0, -1, 0})) << "coplanar, across the corner";
  EXPECT_FALSE(meets_flat({0, 0, 0}, {1, 1, 1}, {2, 1, 1})) << "on one side of the plane";
  EXPECT_FALSE(meets_flat({0, 0, 0}, {-1, -1, 1}, {-1, -1, -1})) << "through the plane, outside";
  EXPECT_TRUE(meets_flat({0, 0, 0}, {1, 1, 1}, {1, 1, -1})) << "through the inside";
  EXPECT_TRUE(meets_flat({0, 0, 0}, {9, 9, 1}, {9, 9, -1})) << "through the opposite side";
  EXPECT_TRUE(meets_flat({0, 0, 0}, {1, 1, 0}, {1, 1, 1})) << "a side on the inside";
  EXPECT_TRUE(meets_flat({0, 0, 0}, {2, 0, 0}, {2, 0, 1})) << "a side along a side";
  EXPECT_TRUE(meets_flat({0, 0, 0}, {1, 1, 0}, {-1, 1, 0})) << "coplanar, overlapping";
  EXPECT_TRUE(meets_flat({0, 0, 0}, {2, 0, 0}, {0, -2, 0})) << "coplanar, along a side";
}

TEST(TrianglePair, SharedSide) {
  EXPECT_FALSE(meets_flat({0, 0, 0}, {4, 0, 0}, {1, -1, 0})) << "flat";
  EXPECT_FALSE(meets_flat({0, 0, 0}, {4, 0, 0}, {1, 1, 1})) << "bent";
  EXPECT_FALSE(meets_flat({0, 0, 0}, {4, 0, 0}, {1, 1, 0x1p-40})) << "almost folded";
  EXPECT_TRUE(meets_flat({0, 0, 0}, {4, 0, 0}, {1, 1, 0})) << "folded";
  EXPECT_TRUE(meets_flat({0, 0, 0}, {4, 0, 0}, {-9, 1, 0})) << "folded and sheared";
}

TEST(TrianglePair, AllCornersShared) {
  EXPECT_TRUE(agree(kFlat, kFlat));
}

TEST(TrianglePair, DegenerateTrianglesAreDetected) {
  EXPECT_FALSE(analysis::is_degenerate(kFlat));
  EXPECT_TRUE(analysis::is_degenerate({Point(1, 2, 3), Point(1, 2, 3), Point(4, 5, 6)}));
  EXPECT_TRUE(analysis::is_degenerate({Point(1, 2, 3), Point(2, 4, 6), Point(3, 6, 9)}));
  EXPECT_FALSE(analysis::is_degenerate({Point(1, 2, 3), Point(2, 4, 6), Point(3, 6, 9 + 0x1p-20)}));
  for (int axis = 0; axis < 3; ++axis) {
    analysis::ExactTriangle t{Point(1), Point(1), Point(1)};
    t[1][axis] = 2;
    t[2][(axis + 1) % 3] = 2;
    EXPECT_FALSE(analysis::is_degenerate(t)) << axis;
  }
}

/// Independent of the code under test except for the orientation predicate. Two triangles that
/// share no corner and are not coplanar intersect exactly if a side of one meets the other.
bool side_meets(const Point& p, const Point& q, const analysis::ExactTriangle& t) {
  const int from = analysis::orientation(t[0], t[1], t[2], p);
  const int to = analysis::orientation(t[0], t[1], t[2], q);
  if (from * to > 0) return false;
  if (from == 0 && to == 0) {
    // A point above the plane and each side span a wall. The segment is outside if it is outside
    // one wall, or if all corners are on one side of the segment's own wall.
    for (const Point& apex :
         {t[0] + Point(1, 0, 0), t[0] + Point(0, 1, 0), t[0] + Point(0, 0, 1)}) {
      if (analysis::orientation(t[0], t[1], t[2], apex) == 0) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const Point& a = t[i];
        const Point& b = t[(i + 1) % 3];
        const int inside = analysis::orientation(a, b, apex, t[(i + 2) % 3]);
        if (inside * analysis::orientation(a, b, apex, p) < 0 &&
            inside * analysis::orientation(a, b, apex, q) < 0) {
          return false;
        }
      }
      const Point up = p + (apex - t[0]);
      const int a = analysis::orientation(p, q, up, t[0]);
      const int b = analysis::orientation(p, q, up, t[1]);
      const int c = analysis::orientation(p, q, up, t[2]);
      return !(a == b && b == c && a != 0);
    }
  }
  const int a = analysis::orientation(p, q, t[0], t[1]);
  const int b = analysis::orientation(p, q, t[1], t[2]);
  const int c = analysis::orientation(p, q, t[2], t[0]);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

bool any_side_meets(const analysis::ExactTriangle& a, const analysis::ExactTriangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (side_meets(a[i], a[(i + 1) % 3], b) || side_meets(b[i], b[(i + 1) % 3], a)) return true;
  }
  return false;
}

TEST(TrianglePair, AgreesWithSideTestsOnSmallGrids) {
  // With few possible corner positions, every kind of contact comes up often.
  std::mt19937 random(7);
  std::array<int, 2> met{};
  for (int i = 0; i < 300'000; ++i) {
    const int size = 2 + i % 4;
    const auto coordinate = [&] { return static_cast<double>(random() % size); };
    analysis::ExactTriangle a;
    analysis::ExactTriangle b;
    for (analysis::ExactTriangle* t : {&a, &b}) {
      for (Point& p : *t)
        p = {coordinate(), coordinate(), coordinate()};
    }
    if (analysis::is_degenerate(a) || analysis::is_degenerate(b)) continue;
    bool is_shared = false;
    for (const Point& p : a)
      is_shared |= std::find(b.begin(), b.end(), p) != b.end();
    if (is_shared) continue;
    // One of two coplanar triangles may be inside the other, but then its sides are, too.
    const bool expected = any_side_meets(a, b);
    ASSERT_EQ(analysis::do_intersect(a, b), expected);
    ++met[expected ? 1 : 0];
  }
  EXPECT_GT(met[0], 20'000);
  EXPECT_GT(met[1], 20'000);
}

TEST(TrianglePair, SharedCornerAgreesWithCutCorners) {
  // The triangles meet in more than the shared corner exactly if one of them, after a small piece
  // at that corner is cut off, meets the other. On an integer grid no meeting point is that near
  // the corner.
  std::mt19937 random(11);
  std::array<int, 2> met{};
  for (int i = 0; i < 100'000; ++i) {
    const int size = 3 + i % 4;
    const auto point = [&] {
      return 1024.0 *
             Point(static_cast<double>(random() % size) - 1, random() % size, random() % size);
    };
    const analysis::ExactTriangle a{Point(0), point(), point()};
    const analysis::ExactTriangle b{Point(0), point(), point()};
    if (analysis::is_degenerate(a) || analysis::is_degenerate(b)) continue;
    if (a[1] == b[1] || a[1] == b[2] || a[2] == b[1] || a[2] == b[2]) continue;
    const Point near1 = a[1] / 1024.0;
    const Point near2 = a[2] / 1024.0;
    const bool expected =
        any_side_meets({near1, a[1], a[2]}, b) || any_side_meets({near1, a[2], near2}, b);
    ASSERT_EQ(analysis::do_intersect(a, b), expected);
    ++met[expected ? 1 : 0];
  }
  EXPECT_GT(met[0], 5'000);
  EXPECT_GT(met[1], 5'000);
}

}  // namespace
}  // namespace mesher::test
