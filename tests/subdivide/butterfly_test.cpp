// The engine's interpolating schemes beside OpenMesh and the oracles.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/subdivide/subdivide.h"
#include "tests/subdivide/butterfly_oracle.h"
#include "tests/subdivide/compare.h"
#include "tests/subdivide/models.h"
#include "tests/subdivide/openmesh_reference.h"

namespace mesher::test {
namespace {

constexpr std::uint32_t kLevels = 3;

/// Models of different shapes: sharpness is nothing to these schemes.
std::vector<const Model*> shapes() {
  std::vector<const Model*> result;
  for (const Model& model : models()) {
    if (is_untagged(model.mesh)) result.push_back(&model);
  }
  return result;
}

Mesh subdivided(const Mesh& mesh, Scheme scheme, std::uint32_t levels) {
  return subdivide(mesh, {.levels = levels, .scheme = scheme}).mesh;
}

TEST(Butterfly, AgreesWithOpenMeshOnEveryModelAndLevel) {
  ASSERT_GE(shapes().size(), 25U);
  for (const Model* model : shapes()) {
    SCOPED_TRACE(model->name);
    PlainMesh theirs = plain_mesh(model->mesh, BoundaryRounding::edge_only);
    const double tolerance = kTolerance * diagonal(theirs.positions);
    const std::uint32_t levels = affordable_levels(model->mesh, kLevels);
    for (std::uint32_t level = 1; level <= levels; ++level) {
      SCOPED_TRACE("level " + std::to_string(level));
      theirs = openmesh_butterfly(theirs);
      expect_same(subdivided(model->mesh, Scheme::butterfly, level), theirs, tolerance);
    }
  }
}

TEST(Butterfly, TheOracleAgreesWithOpenMesh) {
  for (const Model* model : shapes()) {
    SCOPED_TRACE(model->name);
    PlainMesh mesh = plain_mesh(model->mesh, BoundaryRounding::edge_only);
    for (std::uint32_t level = 1; level <= 2; ++level) {
      const PlainMesh oracle = refine_butterfly(mesh);
      EXPECT_LT(largest_distance(oracle.positions, openmesh_butterfly(mesh).positions),
                1e-12 * diagonal(mesh.positions));
      mesh = oracle;
    }
  }
}

TEST(Butterfly, AgreesWithTheOracleWhateverIsSharp) {
  for (const Model& model : models()) {
    if (is_untagged(model.mesh)) continue;
    SCOPED_TRACE(model.name);
    const PlainMesh mesh = plain_mesh(model.mesh, BoundaryRounding::edge_only);
    expect_same(subdivided(model.mesh, Scheme::butterfly, 2),
                refine_butterfly(refine_butterfly(mesh)), kTolerance * diagonal(mesh.positions));
  }
}

TEST(Midpoint, HalvesEdgesAndMovesNothing) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    const PlainMesh mesh = plain_mesh(model.mesh, BoundaryRounding::edge_only);
    const Mesh fine = subdivided(model.mesh, Scheme::midpoint, 2);
    expect_same(fine, refine_midpoint(refine_midpoint(mesh)),
                kTolerance * diagonal(mesh.positions));
  }
}

TEST(Interpolating, OldVerticesStayToTheBit) {
  for (const Scheme scheme : {Scheme::butterfly, Scheme::midpoint}) {
    for (const bool limit : {false, true}) {
      for (const Model* model : shapes()) {
        SCOPED_TRACE(model->name);
        const Mesh fine =
            subdivide(model->mesh, {.levels = 2, .scheme = scheme, .limit = limit}).mesh;
        ASSERT_GE(fine.vertex_count(), model->mesh.vertex_count());
        EXPECT_TRUE(std::equal(model->mesh.positions().begin(), model->mesh.positions().end(),
                               fine.positions().begin()));
      }
    }
  }
}

}  // namespace
}  // namespace mesher::test
