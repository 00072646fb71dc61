#include "engine/simplify/intersection_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "engine/analysis/self_intersections.h"
#include "engine/core/parallel.h"
#include "engine/simplify/new_intersections.h"
#include "engine/simplify/simplify.h"
#include "tests/simplify/replay.h"
#include "tests/support/assets.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

/// Counts the pairs that intersect in the result but not in the input.
std::size_t count_new_pairs(const Mesh& input, const simplify::Simplified& result) {
  const auto before = analysis::self_intersections(input);
  std::size_t count = 0;
  for (const auto& [a, b] : analysis::self_intersections(result.mesh)) {
    const Face first = result.face_source[a.index()];
    const Face second = result.face_source[b.index()];
    const analysis::FacePair pair{std::min(first, second), std::max(first, second)};
    count += std::binary_search(before.begin(), before.end(), pair) ? 0U : 1U;
  }
  return count;
}

/// With an observer the run checks each collapse. Without one it checks the finished result first.
void expect_no_new_pair(const Mesh& mesh, simplify::SimplifyOptions options) {
  options.no_intersections = true;
  simplify::CollapseRecorder recorder;
  for (simplify::CollapseObserver* observer :
       {static_cast<simplify::CollapseObserver*>(nullptr),
        static_cast<simplify::CollapseObserver*>(&recorder)}) {
    options.observer = observer;
    const simplify::Simplified result = simplify::simplify(Mesh(mesh), options);
    expect_valid(result.mesh);
    EXPECT_EQ(topology(result.mesh), topology(mesh));
    EXPECT_EQ(count_new_pairs(mesh, result), 0U)
        << key(options.cost) << " to " << options.target_faces;
  }
}

TEST(NoIntersections, ResultIsUnchangedWhenNoneAppear) {
  const Mesh bunny = asset("bunny_1k.obj");
  const simplify::Simplified plain = simplify::simplify(Mesh(bunny), {.target_faces = 300});
  ASSERT_EQ(analysis::count_self_intersections(plain.mesh), 0U)
      << "this model no longer tests anything";
  const simplify::Simplified kept =
      simplify::simplify(Mesh(bunny), {.target_faces = 300, .no_intersections = true});
  EXPECT_TRUE(is_identical(kept.mesh, plain.mesh));
  EXPECT_FALSE(simplify::has_new_intersections(bunny, kept));
}

TEST(NoIntersections, PairsOfTheInputAreNotNew) {
  const Mesh knot = asset("knot.obj");
  const simplify::Simplified free = simplify::simplify(Mesh(knot), {.target_faces = 4});
  EXPECT_TRUE(simplify::has_new_intersections(knot, free));
  // The same faces with themselves as their input.
  simplify::Simplified same{
      .mesh = free.mesh, .report = {}, .vertex_source = {}, .face_source = {}};
  for (std::uint32_t f = 0; f < free.mesh.face_count(); ++f)
    same.face_source.emplace_back(f);
  EXPECT_FALSE(simplify::has_new_intersections(free.mesh, same));
}

/// Two tori, one just inside the other: distant along the surface, close in space.
Soup shells(std::uint32_t n, std::uint32_t m, float gap) {
  Soup outer = torus(n, m);
  Soup inner = outer;
  for (std::size_t i = 0; i < inner.positions.size(); ++i) {
    glm::vec3& p = inner.positions[i];
    const float around = std::sqrt(p.x * p.x + p.y * p.y);
    const glm::vec3 middle(2.0F * p.x / around, 2.0F * p.y / around, 0.0F);
    p = middle + (1.0F - gap) * (p - middle);
  }
  return join(outer, inner);
}

Soup with_noise(Soup soup, float size, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (glm::vec3& p : soup.positions) {
    for (int i = 0; i < 3; ++i)
      p[i] += size * (static_cast<float>(random() % 2001) / 1000.0F - 1.0F);
  }
  return soup;
}

TEST(NoIntersections, KnotHasNoneAtTheLastLegalCollapse) {
  const Mesh knot = asset("knot.obj");
  const simplify::Simplified free = simplify::simplify(Mesh(knot), {.target_faces = 4});
  EXPECT_GT(analysis::count_self_intersections(free.mesh), 10U)
      << "this model no longer tests anything";
  const simplify::Simplified kept =
      simplify::simplify(Mesh(knot), {.target_faces = 4, .no_intersections = true});
  EXPECT_EQ(analysis::count_self_intersections(kept.mesh), 0U);
  EXPECT_EQ(kept.report.reason, simplify::StopReason::no_legal_collapse);
  EXPECT_GT(kept.report[simplify::Rejection::intersection], 0U);
  EXPECT_LT(kept.report.faces_reached, 80U);
}

TEST(NoIntersections, KnotHasNoneAfterAnyCollapse) {
  const Mesh knot = asset("knot.obj");
  simplify::CollapseRecorder recorder;
  const simplify::Simplified result = simplify::simplify(
      Mesh(knot), {.target_faces = 4, .no_intersections = true, .observer = &recorder});
  const std::size_t steps = recorder.records().size();
  replay(Mesh(knot), recorder.records(), [&](const Mesh& step, std::size_t i) {
    if (i % 50 != 0 && i + 100 <= steps) return;
    ASSERT_EQ(analysis::count_self_intersections(step), 0U) << i;
  });
}

TEST(NoIntersections, NoNewPairsAtAnyTarget) {
  for (const char* name : {"knot.obj", "bunny.obj", "bunny_1k.obj", "cactus.obj"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = asset(name);
    for (const double ratio : {0.7, 0.3, 0.1, 0.03, 0.001}) {
      const auto target = static_cast<std::uint32_t>(ratio * mesh.face_count());
      expect_no_new_pair(mesh, {.target_faces = std::max(target, 4U)});
    }
  }
}

TEST(NoIntersections, NoNewPairsForAnyCost) {
  const Mesh mesh = built(with_noise(shells(40, 24, 0.02F), 0.004F, 3)).mesh;
  const std::vector<std::uint32_t> targets =
      kSanitized ? std::vector{200U} : std::vector{1'000U, 200U, 4U};
  for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
    for (const std::uint32_t target : targets)
      expect_no_new_pair(mesh,
                         {.target_faces = target, .cost = static_cast<simplify::CostPolicy>(p)});
  }
}

TEST(NoIntersections, NoNewPairsOnRandomClosedShapes) {
  std::size_t with_pairs = 0;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const float noise = 0.02F * static_cast<float>(seed % 10);
    const Mesh mesh = built(with_noise(torus(16 + seed, 12), noise, seed)).mesh;
    with_pairs += analysis::self_intersections(mesh).empty() ? 0U : 1U;
    expect_no_new_pair(mesh, {.target_faces = seed % 3 == 0 ? 4U : 100U});
  }
  EXPECT_GT(with_pairs, 5U) << "no input that intersects itself";
}

TEST(NoIntersections, NoNewPairsOnMeshesWithBoundary) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    Soup sheets = join(grid(20), grid(20), {0.0F, 0.0F, 0.1F});
    expect_no_new_pair(built(with_noise(std::move(sheets), 0.045F, seed)).mesh,
                       {.target_faces = 50});
  }
}

TEST(NoIntersections, NoNewPairsBetweenRegions) {
  const Mesh mesh = built(with_noise(shells(300, 100, 0.002F), 0.0003F, 1)).mesh;
  ASSERT_EQ(analysis::count_self_intersections(mesh), 0U);
  const simplify::Simplified free = simplify::simplify(Mesh(mesh), {.target_faces = 20'000});
  EXPECT_GT(analysis::count_self_intersections(free.mesh), 10U)
      << "this model no longer tests anything";
  simplify::CollapseRecorder recorder;
  const simplify::Simplified kept = simplify::simplify(
      Mesh(mesh), {.target_faces = 20'000, .no_intersections = true, .observer = &recorder});
  EXPECT_EQ(analysis::count_self_intersections(kept.mesh), 0U);
  // Sorted by rank, the order that progressive meshes use, the collapses of several regions
  // alternate.
  auto records = recorder.records();
  std::ranges::stable_sort(records, {}, &simplify::CollapseRecord::rank);
  const std::size_t steps = records.size();
  replay(Mesh(mesh), records, [&](const Mesh& step, std::size_t i) {
    if (i % (steps / 8) != 0) return;
    ASSERT_EQ(analysis::count_self_intersections(step), 0U) << i;
  });
}

/// Without an observer, a region of its own collapses the places where pairs appear otherwise.
TEST(NoIntersections, NoNewPairsBetweenDistantSheets) {
  const Mesh mesh = built(with_noise(shells(300, 100, 0.002F), 0.0003F, 1)).mesh;
  const simplify::Simplified free = simplify::simplify(Mesh(mesh), {.target_faces = 20'000});
  EXPECT_TRUE(simplify::has_new_intersections(mesh, free)) << "this model no longer tests anything";
  const simplify::Simplified kept =
      simplify::simplify(Mesh(mesh), {.target_faces = 20'000, .no_intersections = true});
  EXPECT_FALSE(simplify::has_new_intersections(mesh, kept));
  EXPECT_EQ(kept.mesh.face_count(), 20'000U);
}

TEST(NoIntersections, SameBytesForAnyThreadCount) {
  const Mesh mesh = built(with_noise(shells(200, kSanitized ? 30 : 100, 0.02F), 0.001F, 2)).mesh;
  const simplify::SimplifyOptions options{.target_faces = 2'000, .no_intersections = true};
  const simplify::Simplified first = simplify::simplify(Mesh(mesh), options);
  for (const unsigned threads : {1U, 2U, 4U}) {
    const ThreadLimit limit(threads);
    EXPECT_TRUE(is_identical(simplify::simplify(Mesh(mesh), options).mesh, first.mesh));
  }
}

TEST(NoIntersections, CombineWithAnErrorBound) {
  const Mesh mesh = built(shells(40, 24, 0.05F)).mesh;
  const simplify::Simplified result =
      simplify::simplify(Mesh(mesh), {.max_error = 0.1, .no_intersections = true});
  EXPECT_LE(result.report.measured_error, 0.1);
  EXPECT_LT(result.report.faces_reached, mesh.face_count() / 2);
  EXPECT_EQ(analysis::count_self_intersections(result.mesh), 0U);
}

TEST(NoIntersections, PairsOfTheInputMayStay) {
  const Mesh mesh = built(join(torus(40, 24), torus(40, 24), {1.0F, 0.5F, 0.25F})).mesh;
  EXPECT_GT(analysis::count_self_intersections(mesh), 0U);
  const simplify::Simplified result =
      simplify::simplify(Mesh(mesh), {.target_faces = 1'000, .no_intersections = true});
  EXPECT_EQ(result.report.reason, simplify::StopReason::target_reached);
  EXPECT_EQ(count_new_pairs(mesh, result), 0U);
}

}  // namespace
}  // namespace mesher::test
