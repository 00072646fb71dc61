// Compares the hoppe94 rules of the engine with an independent implementation.
#include <gtest/gtest.h>

#include "engine/subdivide/subdivide.h"
#include "tests/subdivide/compare.h"
#include "tests/subdivide/hoppe94_oracle.h"
#include "tests/subdivide/models.h"

namespace mesher::test {
namespace {

struct Setting {
  subdivide::BoundaryRounding boundary = subdivide::BoundaryRounding::edge_only;
  subdivide::CreaseDecay decay = subdivide::CreaseDecay::uniform;
  std::uint32_t levels = 1;
};

void compare(const Model& model, const Setting& setting) {
  const OracleRules rules = hoppe94_rules(setting.decay);
  PlainMesh oracle = plain_mesh(model.mesh, setting.boundary);
  const double tolerance = kTolerance * diagonal(oracle.positions);
  for (std::uint32_t level = 0; level <= setting.levels; ++level) {
    SCOPED_TRACE("level " + std::to_string(level));
    if (level > 0) oracle = refine(oracle, rules);
    subdivide::SubdivideOptions options{
        .levels = level, .boundary = setting.boundary, .decay = setting.decay};
    const Mesh ours = subdivide::subdivide(model.mesh, options).mesh;
    expect_same(ours, oracle, tolerance);
    expect_same_sharpness(ours, oracle);
    constexpr std::size_t kMostForLimits = 500;
    if (oracle.triangles.size() > kMostForLimits) continue;
    SCOPED_TRACE("limit");
    options.limit = true;
    PlainMesh limit = oracle;
    limit.positions = limit_positions(oracle, rules);
    expect_same(subdivide::subdivide(model.mesh, options).mesh, limit, tolerance);
  }
}

class Hoppe94 : public ::testing::TestWithParam<subdivide::BoundaryRounding> {};

TEST_P(Hoppe94, AgreesWithOracleOnEveryModelAndLevel) {
  std::size_t compared = 0;
  for (const Model& model : models()) {
    if (!is_settled(model.mesh)) continue;
    const bool is_new =
        GetParam() == subdivide::BoundaryRounding::edge_only || has_boundary(model.mesh);
    SCOPED_TRACE(model.name);
    compare(model,
            {.boundary = GetParam(), .levels = is_new ? affordable_levels(model.mesh, 4) : 1});
    ++compared;
  }
  EXPECT_GE(compared, 40U);
}

TEST_P(Hoppe94, SoftCreasesDecayAndBlendAsInDeRose) {
  std::size_t compared = 0;
  for (const Model& model : models()) {
    if (is_settled(model.mesh)) continue;
    if (GetParam() != subdivide::BoundaryRounding::edge_only && !has_boundary(model.mesh)) continue;
    for (const subdivide::CreaseDecay decay : kDecays) {
      SCOPED_TRACE(model.name +
                   (decay == subdivide::CreaseDecay::uniform ? ", uniform" : ", chaikin"));
      compare(model, {.boundary = GetParam(), .decay = decay, .levels = 3});
      ++compared;
    }
  }
  EXPECT_GE(compared, 4U);
}

INSTANTIATE_TEST_SUITE_P(EveryBoundary, Hoppe94, ::testing::ValuesIn(kBoundaries));

}  // namespace
}  // namespace mesher::test
