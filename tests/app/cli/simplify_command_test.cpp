#include "app/cli/simplify_command.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/error.h"

namespace mesher::app {
namespace {

TEST(SimplifyArguments, TargetIsFacesRatioOrError) {
  EXPECT_EQ(simplify_options({.faces = 50}, 1000, 10.0).target_faces, 50U);
  EXPECT_EQ(simplify_options({.ratio = 0.25}, 1000, 10.0).target_faces, 250U);
  EXPECT_EQ(simplify_options({.ratio = 1e-9}, 1000, 10.0).target_faces, 1U);
  EXPECT_EQ(simplify_options({.ratio = 1.0}, 1000, 10.0).target_faces, 1000U);
  const simplify::SimplifyOptions units = simplify_options({.max_error = "0.25"}, 1000, 10.0);
  EXPECT_EQ(units.target_faces, 0U);
  EXPECT_EQ(units.max_error, 0.25);
  const simplify::SimplifyOptions percent =
      simplify_options({.faces = 9, .max_error = "5%"}, 1000, 10.0);
  EXPECT_EQ(percent.target_faces, 9U);
  EXPECT_DOUBLE_EQ(percent.max_error, 0.5);
  EXPECT_TRUE(std::isinf(simplify_options({.faces = 9}, 1000, 10.0).max_error));
}

TEST(SimplifyArguments, RulesArePassedOn) {
  const simplify::SimplifyOptions rules{.cost = simplify::CostPolicy::shape,
                                        .placement = simplify::Placement::endpoint,
                                        .boundary = simplify::BoundaryRule::lock,
                                        .crease_angle_deg = 30.0F,
                                        .seed = 7,
                                        .no_intersections = true};
  const simplify::SimplifyOptions o = simplify_options({.faces = 1, .rules = rules}, 9, 1.0);
  EXPECT_EQ(o.cost, simplify::CostPolicy::shape);
  EXPECT_EQ(o.placement, simplify::Placement::endpoint);
  EXPECT_EQ(o.boundary, simplify::BoundaryRule::lock);
  EXPECT_EQ(o.crease_angle_deg, 30.0F);
  EXPECT_EQ(o.seed, 7U);
  EXPECT_TRUE(o.no_intersections);
}

TEST(SimplifyArguments, PruningWithErrorBoundIsRejected) {
  EXPECT_THROW((void)simplify_options({.max_error = "1%", .prune = true}, 9, 1.0), UsageError);
  EXPECT_THROW((void)simplify_options({.faces = 4, .max_error = "1", .prune = true}, 9, 1.0),
               UsageError);
  EXPECT_EQ(simplify_options({.faces = 4, .prune = true}, 9, 1.0).target_faces, 4U);
}

TEST(SimplifyArguments, InvalidTargetsAreRejected) {
  EXPECT_THROW((void)simplify_options({}, 9, 1.0), UsageError);
  for (const double ratio : {0.0, -0.5, 1.01, std::nan("")})
    EXPECT_THROW((void)simplify_options({.ratio = ratio}, 9, 1.0), UsageError) << ratio;
  for (const char* error : {"%", "x", "0", "-1", "1 %", "nan", "inf", "1%%", "0%"})
    EXPECT_THROW((void)simplify_options({.max_error = error}, 9, 1.0), UsageError) << error;
}

}  // namespace
}  // namespace mesher::app
