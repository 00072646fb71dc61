#include "engine/simplify/quadric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/simplify/surface.h"

namespace mesher::test {
namespace {

using V = Vec3<float>;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float number() { return std::uniform_real_distribution<float>(-1.0F, 1.0F)(engine_); }
  V vector() { return {number(), number(), number()}; }
  V unit() {
    const V v = vector();
    return v * (1.0F / std::sqrt(dot(v, v)));
  }

 private:
  std::mt19937 engine_;
};

struct Plane {
  V normal;
  float area;
};

simplify::Quadric<float> sum(const std::vector<Plane>& planes) {
  simplify::Quadric<float> q{};
  for (const Plane& p : planes)
    q = q + simplify::plane_quadric(p.normal, p.area);
  return q;
}

std::vector<Plane> random_planes(Random& random, int count) {
  std::vector<Plane> planes;
  for (int i = 0; i < count; ++i)
    planes.push_back({random.unit(), 0.1F + std::abs(random.number())});
  return planes;
}

TEST(Quadric, EqualsTheSumOfAreasTimesSquaredDistances) {
  Random random(1);
  for (int run = 0; run < 200; ++run) {
    const std::vector<Plane> from = random_planes(random, 6);
    const std::vector<Plane> to = random_planes(random, 5);
    const V edge = random.vector();
    const simplify::EdgeQuadric<float> q(sum(from), sum(to), V{}, edge);
    const V y = random.vector();
    // The ends are half an edge before and after the midpoint, and planes pass through them.
    double expected = 0.0;
    for (const Plane& p : from) {
      expected += double(p.area) * std::pow(double(dot(p.normal, y + edge * 0.5F)), 2);
    }
    for (const Plane& p : to) {
      expected += double(p.area) * std::pow(double(dot(p.normal, y - edge * 0.5F)), 2);
    }
    EXPECT_NEAR(double(q.cost(y)), expected, 1e-5 * (1.0 + expected));
  }
}

TEST(Quadric, LanesMatchTheScalarResultBitwise) {
  Random random(2);
  for (int run = 0; run < 100; ++run) {
    const std::vector<Plane> from = random_planes(random, 6);
    const std::vector<Plane> to = random_planes(random, 6);
    const V edge = random.vector() * 3.0F;
    const V shared = random.vector();
    const simplify::EdgeQuadric<float> one(sum(from), sum(to), shared, edge);
    const auto wide = [](float x) { return broadcast<Float8>(x); };
    const auto wide_vector = [&](const V& v) {
      return Vec3<Float8>{wide(v.x), wide(v.y), wide(v.z)};
    };
    const auto wide_quadric = [&](const simplify::Quadric<float>& q) {
      return simplify::Quadric<Float8>{wide(q.xx), wide(q.xy), wide(q.xz),      wide(q.yy),
                                       wide(q.yz), wide(q.zz), wide_vector(q.g)};
    };
    const simplify::EdgeQuadric<Float8> eight(wide_quadric(sum(from)), wide_quadric(sum(to)),
                                              wide_vector(shared), wide_vector(edge));
    const Float8 costs = eight.ranked_cost(simplify::best_offset(eight));
    const float expected = one.ranked_cost(simplify::best_offset(one));
    for (int lane = 0; lane < 4; ++lane) {
      EXPECT_EQ(costs.low[lane], expected);
      EXPECT_EQ(costs.high[lane], expected);
    }
  }
}

TEST(Quadric, RowsGiveTheSameSums) {
  Random random(3);
  for (int run = 0; run < 50; ++run) {
    const V n = random.unit();
    const simplify::FaceShape shape{{n.x, n.y, n.z}, 0.7F};
    simplify::VertexState state{};
    const simplify::QuadricRows rows = simplify::plane_rows(load4(&shape.normal.x));
    store4(&state.quadric.xx, rows.a);
    store4(&state.quadric.xx + 4, rows.b);
    store4(&state.quadric.xx + 8, rows.c);
    const simplify::Quadric<float> q = simplify::plane_quadric(shape);
    EXPECT_EQ(state.quadric.xx, q.xx);
    EXPECT_EQ(state.quadric.xy, q.xy);
    EXPECT_EQ(state.quadric.xz, q.xz);
    EXPECT_EQ(state.quadric.yy, q.yy);
    EXPECT_EQ(state.quadric.yz, q.yz);
    EXPECT_EQ(state.quadric.zz, q.zz);
    EXPECT_EQ(state.quadric.g.x, q.g.x);
    EXPECT_EQ(state.quadric.g.y, q.g.y);
    EXPECT_EQ(state.quadric.g.z, q.g.z);
    EXPECT_EQ(state.position.x, 0.0F);
    EXPECT_EQ(state.position.z, 0.0F);
  }
}

TEST(BestOffset, IsTheCornerOfThreePlanes) {
  const V edge{1.0F, 0.0F, 0.0F};
  const V axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  simplify::Quadric<float> from{};
  simplify::Quadric<float> to{};
  to = to + simplify::plane_quadric(axes[0], 1.0F);
  from = from + simplify::plane_quadric(axes[1], 1.0F) + simplify::plane_quadric(axes[2], 1.0F);
  const simplify::EdgeQuadric<float> q(from, to, V{}, edge);
  const V y = simplify::best_offset(q);
  // The plane of the far end determines x, those of the near end y and z. The corner is the far
  // end.
  EXPECT_NEAR(y.x, 0.5F, 1e-3F);
  EXPECT_NEAR(y.y, 0.0F, 1e-3F);
  EXPECT_NEAR(y.z, 0.0F, 1e-3F);
}

TEST(BestOffset, IsNoWorseThanTheMidpointAndKeepsTheVolume) {
  Random random(4);
  int kept = 0;
  for (int run = 0; run < 500; ++run) {
    // A gently curved neighborhood: normals near z.
    std::vector<Plane> planes[2];
    for (std::vector<Plane>& side : planes) {
      for (int i = 0; i < 6; ++i) {
        V n = V{0.2F * random.number(), 0.2F * random.number(), 1.0F};
        side.push_back({n * (1.0F / std::sqrt(dot(n, n))), 0.5F});
      }
    }
    const V edge{1.0F, 0.3F * random.number(), 0.05F * random.number()};
    const simplify::EdgeQuadric<float> q(sum(planes[0]), sum(planes[1]), V{}, edge);
    const V y = simplify::best_offset(q);
    EXPECT_LE(dot(y, y), dot(q.half, q.half) * 1.0001F);
    const float missed = std::abs(dot(q.both.g, y) - q.volume);
    kept += missed < 1e-3F ? 1 : 0;
  }
  EXPECT_GT(kept, 450) << "all except the few that the ball clamps";
}

TEST(BestOffset, StaysAtTheMidpointWhenUnconstrained) {
  // A flat neighborhood: all normals along z. Moving in the plane costs nothing.
  const std::vector<Plane> flat(6, Plane{{0, 0, 1}, 1.0F});
  const simplify::EdgeQuadric<float> on_plane(sum(flat), sum(flat), V{0, 0, 2}, {0.3F, 0.4F, 0.0F});
  const V y = simplify::best_offset(on_plane);
  EXPECT_NEAR(std::sqrt(dot(y, y)), 0.0F, 1e-6F);
  // A straight crease along x. The vertex could slide along it but must not.
  std::vector<Plane> crease(3, Plane{{0, 0, 1}, 1.0F});
  crease.insert(crease.end(), 3, Plane{{0, 1, 0}, 1.0F});
  const simplify::EdgeQuadric<float> on_crease(sum(crease), sum(crease), V{0, 1, 1},
                                               {1.0F, 0.0F, 0.0F});
  const V z = simplify::best_offset(on_crease);
  EXPECT_NEAR(std::sqrt(dot(z, z)), 0.0F, 1e-6F);
}

TEST(BestOffset, IsFiniteForAnyInput) {
  Random random(5);
  const float sizes[] = {0.0F, 1e-12F, 1e-6F, 1.0F, 1e6F};
  for (int run = 0; run < 2'000; ++run) {
    const float size = sizes[run % 5];
    std::vector<Plane> from = random_planes(random, run % 4);
    std::vector<Plane> to = random_planes(random, run % 3);
    for (std::vector<Plane>* side : {&from, &to}) {
      for (Plane& p : *side)
        p.area *= size * size;
    }
    const V edge = random.vector() * (run % 7 == 0 ? 0.0F : size);
    // A face that both ends share.
    const V shared = from.empty() ? V{} : from[0].normal * from[0].area;
    const simplify::EdgeQuadric<float> q(sum(from), sum(to), shared, edge);
    const V y = simplify::best_offset(q);
    EXPECT_TRUE(std::isfinite(y.x) && std::isfinite(y.y) && std::isfinite(y.z));
    EXPECT_TRUE(dot(y, y) <= dot(q.half, q.half) * 1.0001F + 1e-37F);
    EXPECT_GE(q.ranked_cost(y), 0.0F);
  }
}

// The rest of a sum may be negative after a much larger part of it was subtracted.
TEST(RankedCost, IsNeverNegative) {
  const std::vector<Plane> small(3, Plane{{0, 0, 1}, 1e-9F});
  const simplify::Quadric<float> left =
      sum(small) - sum(std::vector<Plane>(3, Plane{{0, 0, 1}, 1e-6F}));
  const simplify::EdgeQuadric<float> q(left, left, V{}, {1, 0, 1});
  EXPECT_LT(q.both.trace(), 0.0F);
  EXPECT_GE(q.ranked_cost(simplify::best_offset(q)), 0.0F);
  EXPECT_GE(simplify::guessed_cost(left, left, V{1, 0, 1}), 0.0F);
}

TEST(BetterEnd, IsTheCheaperEnd) {
  Random random(6);
  for (int run = 0; run < 200; ++run) {
    const simplify::EdgeQuadric<float> q(sum(random_planes(random, 5)),
                                         sum(random_planes(random, 6)), V{}, random.vector());
    const float sign = simplify::is_target_better(q) ? 1.0F : -1.0F;
    EXPECT_LE(q.cost(q.half * sign), q.cost(q.half * -sign) + 1e-5F);
  }
}

}  // namespace
}  // namespace mesher::test
