// Flat planes, perfect grids, needles, equal costs, coincident vertices and hubs: the run must not
// stall, place a vertex far away or take quadratic time.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "engine/mesh/statistics.h"
#include "engine/simplify/simplify.h"
#include "tests/simplify/replay.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

void expect_sound(const Mesh& mesh, const simplify::Simplified& result) {
  expect_valid(result.mesh);
  EXPECT_EQ(topology(result.mesh), topology(mesh));
  EXPECT_LE(count_folds(result.mesh), count_folds(mesh));
  // No vertex may lie outside the bounds of the input, except for a small margin.
  const Box before = bounding_box(mesh);
  const Box after = bounding_box(result.mesh);
  const auto slack = static_cast<float>(0.05 * before.diagonal());
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(after.min[axis], before.min[axis] - slack);
    EXPECT_LE(after.max[axis], before.max[axis] + slack);
  }
}

TEST(Degenerate, FlatSheetIsReducedToTwoFaces) {
  for (const std::uint32_t n : {7U, 40U, 130U}) {
    const Mesh sheet = built(grid(n)).mesh;
    const simplify::Simplified result = simplify::simplify(Mesh(sheet), {.target_faces = 2});
    EXPECT_EQ(result.mesh.face_count(), 2U);
    expect_sound(sheet, result);
    EXPECT_NEAR(statistics(result.mesh).area, double(n) * n, 1e-3 * n * n);
    EXPECT_LT(result.report.estimated_error, 3e-4 * bounding_box(sheet).diagonal());
  }
}

TEST(Degenerate, FlatSheetIsReducedEvenly) {
  const Mesh sheet = built(grid(100)).mesh;
  const simplify::Simplified result = simplify::simplify(Mesh(sheet), {.target_faces = 2'000});
  // No vertex becomes a hub.
  std::uint32_t most = 0;
  for (std::uint32_t v = 0; v < result.mesh.vertex_count(); ++v)
    most = std::max(most, result.mesh.valence(Vertex(v)));
  EXPECT_LE(most, 24U);
}

TEST(Degenerate, NeedlesAreSimplified) {
  // A sheet whose faces are a thousand times longer than wide, and a sheet of random slivers.
  Soup soup = grid(60);
  for (glm::vec3& p : soup.positions)
    p.x *= 1000.0F;
  std::mt19937 random(5);
  Soup slivers = grid(60);
  for (glm::vec3& p : slivers.positions)
    p.y += 0.9F * (static_cast<float>(random() % 1000) / 1000.0F - 0.5F);
  for (const Soup& s : {soup, slivers}) {
    const Mesh mesh = built(Soup(s)).mesh;
    for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
      SCOPED_TRACE(key(static_cast<simplify::CostPolicy>(p)));
      const simplify::Simplified result = simplify::simplify(
          Mesh(mesh), {.target_faces = 72, .cost = static_cast<simplify::CostPolicy>(p)});
      expect_sound(mesh, result);
      EXPECT_LE(result.mesh.face_count(), 720U) << key(static_cast<simplify::CostPolicy>(p));
    }
  }
}

TEST(Degenerate, CoincidentVerticesAndZeroAreaFacesAreSimplified) {
  // Every second row coincides with the previous one, so half the faces have no area.
  Soup soup = grid(40);
  for (glm::vec3& p : soup.positions)
    p.y = 2.0F * std::floor(p.y / 2.0F);
  const Mesh mesh = built(std::move(soup)).mesh;
  const simplify::Simplified result = simplify::simplify(Mesh(mesh), {.target_faces = 100});
  expect_sound(mesh, result);
  EXPECT_LE(result.mesh.face_count(), 100U);
  // All vertices at one point.
  Soup point = torus(20, 10);
  for (glm::vec3& p : point.positions)
    p = glm::vec3(1.0F, 2.0F, 3.0F);
  const Mesh nowhere = built(std::move(point)).mesh;
  const simplify::Simplified collapsed = simplify::simplify(Mesh(nowhere), {.target_faces = 50});
  expect_sound(nowhere, collapsed);
  EXPECT_EQ(collapsed.mesh.face_count(), 50U);
}

TEST(Degenerate, HugeAndTinyCoordinatesAreSimplified) {
  for (const float size : {1e-38F, 1e-30F, 1e30F, 1e37F, 2.2e38F}) {
    Soup soup = torus(40, 20);
    for (glm::vec3& p : soup.positions)
      p *= size;
    const Mesh mesh = built(std::move(soup)).mesh;
    const simplify::Simplified result = simplify::simplify(Mesh(mesh), {.target_faces = 100});
    expect_valid(result.mesh);
    EXPECT_EQ(result.mesh.face_count(), 100U);
  }
}

/// A disc with the given number of spokes; `height` lifts the hub.
Mesh disc(std::uint32_t spokes, float height) {
  Soup soup;
  soup.positions.push_back({0, 0, height});
  for (std::uint32_t i = 0; i < spokes; ++i) {
    const double a = 6.283185307179586 * i / spokes;
    soup.positions.push_back(glm::vec3(glm::dvec3(std::cos(a), std::sin(a), 0.0)));
    soup.corners.insert(soup.corners.end(), {0U, i + 1, (i + 1) % spokes + 1});
  }
  return built(std::move(soup)).mesh;
}

double seconds(const Mesh& mesh, const simplify::SimplifyOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const simplify::Simplified result = simplify::simplify(Mesh(mesh), options);
  expect_valid(result.mesh);
  EXPECT_LE(result.mesh.face_count(), std::max(options.target_faces, 8U) * 2);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Quadratic work on 80,000 spokes would take minutes. The test checks the growth, with a margin
// that is large enough for a busy machine.
TEST(Degenerate, HubTakesNoQuadraticTime) {
  for (const float height : {0.0F, 1.0F}) {
    for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
      SCOPED_TRACE(key(static_cast<simplify::CostPolicy>(p)));
      const simplify::SimplifyOptions options{.target_faces = 4,
                                              .cost = static_cast<simplify::CostPolicy>(p)};
      constexpr std::uint32_t kFew = kSanitized ? 400 : 5'000;
      const double few = seconds(disc(kFew, height), options);
      const double many = seconds(disc(16 * kFew, height), options);
      EXPECT_LT(many, 16.0 * 8.0 * std::max(few, 0.005));
    }
  }
}

TEST(Degenerate, EqualCostsAreSimplified) {
  // All edges of an octahedron cost the same.
  const Mesh octahedron =
      built(soup_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}))
          .mesh;
  const simplify::Simplified result = simplify::simplify(Mesh(octahedron), {.target_faces = 4});
  expect_valid(result.mesh);
  EXPECT_LE(result.mesh.face_count(), 6U);
}

// Where a face is a million times larger than its neighbors, their quadrics lose their significant
// digits.
TEST(Degenerate, LongSpikesKeepTopology) {
  for (std::uint32_t seed = 0; seed < (kSanitized ? 4 : 10); ++seed) {
    std::mt19937 random(seed);
    Soup soup = torus(60, 30);
    for (int i = 0; i < 30; ++i)
      soup.positions[random() % soup.positions.size()] *= std::ldexp(1.0F, int(random() % 40));
    const Mesh mesh = built(std::move(soup)).mesh;
    for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
      const simplify::Simplified result = simplify::simplify(
          Mesh(mesh), {.target_faces = 100, .cost = static_cast<simplify::CostPolicy>(p)});
      expect_valid(result.mesh);
      EXPECT_EQ(topology(result.mesh), topology(mesh));
      // Both sides of a spike coincide, and the spikes have nearly all of the area. For costs that
      // are errors, folds there do no harm.
      if (static_cast<simplify::CostPolicy>(p) > simplify::CostPolicy::accumulated_quadric) {
        EXPECT_LE(count_folds(result.mesh), count_folds(mesh));
      }
    }
  }
}

// Each mesh has more parts than fit one region, so the run uses rounds. A round without a legal
// collapse must be the last one.
TEST(Degenerate, EndsWhenNoCollapseIsLegal) {
  Soup tetrahedra;
  for (int i = 0; i < 3'000; ++i)
    tetrahedra = join(std::move(tetrahedra), tetrahedron(), glm::vec3(2.0F * float(i), 0, 0));
  const Mesh closed = built(std::move(tetrahedra)).mesh;
  const simplify::Simplified result = simplify::simplify(Mesh(closed), {.target_faces = 4});
  EXPECT_EQ(result.report.reason, simplify::StopReason::no_legal_collapse);
  EXPECT_EQ(result.mesh.face_count(), closed.face_count());
  const Mesh round = built(torus(200, 50)).mesh;
  const simplify::Simplified all_creases =
      simplify::simplify(Mesh(round), {.target_faces = 4, .crease_angle_deg = 0});
  EXPECT_EQ(all_creases.mesh.face_count(), round.face_count());
  const simplify::Simplified bounded =
      simplify::simplify(Mesh(round), {.target_faces = 4, .max_error = 1e-9});
  EXPECT_EQ(bounded.report.reason, simplify::StopReason::error_bound);
}

TEST(Degenerate, EqualCostsDoNotOvershootTheTarget) {
  const Mesh sheet = built(grid(kSanitized ? 60 : 150)).mesh;
  for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
    for (const std::uint32_t percent : {90U, 80U, 50U, 10U}) {
      const std::uint32_t target = sheet.face_count() * percent / 100;
      const simplify::Simplified result = simplify::simplify(
          Mesh(sheet), {.target_faces = target, .cost = static_cast<simplify::CostPolicy>(p)});
      EXPECT_EQ(result.mesh.face_count(), target) << key(static_cast<simplify::CostPolicy>(p));
    }
  }
}

}  // namespace
}  // namespace mesher::test
