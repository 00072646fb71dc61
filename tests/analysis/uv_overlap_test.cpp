#include "engine/analysis/uv_overlap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/analysis/painted.h"
#include "tests/support/attributes.h"

namespace mesher::test {
namespace {

using analysis::uv_overlap;
using analysis::UvOverlap;

// A texel of the grid, as a share of the texture of a sheet that it covers.
constexpr double kTexel = 1.0 / 1024;

/// A sheet whose right half lies `by` to the left in the texture, which the whole sheet would cover
/// once.
Painted halves(std::uint32_t n, float by) {
  return painted(grid(n), {.uv = [=](const glm::vec3& p, std::size_t face) {
                   const bool is_right = face % (2 * std::size_t{n}) >= n;
                   const glm::vec2 uv = glm::vec2(p) / float(n);
                   return is_right ? uv - glm::vec2(by, 0.0F) : uv;
                 }});
}

TEST(UvOverlap, FacesThatShareEdgesDoNotOverlap) {
  for (const std::uint32_t n : {1U, 2U, 7U, 50U}) {
    const Painted sheet = halves(2 * n, 0.0F);
    const UvOverlap overlap = uv_overlap(sheet.surface(), sheet.surface());
    EXPECT_TRUE(overlap.is_measured);
    EXPECT_EQ(overlap.second, 0.0) << n;
    EXPECT_EQ(overlap.added, 0.0) << n;
  }
}

TEST(UvOverlap, ChartsThatGrowIntoEachOther) {
  const Painted apart = halves(8, 0.0F);
  for (const float by : {0.01F, 0.125F, 0.5F}) {
    const UvOverlap overlap = uv_overlap(apart.surface(), halves(8, by).surface());
    EXPECT_EQ(overlap.original, 0.0);
    EXPECT_NEAR(overlap.second, double(by) / (1.0 - double(by)), 3 * kTexel);
    EXPECT_NEAR(overlap.added, double(by) / (1.0 - double(by)), 3 * kTexel);
  }
}

TEST(UvOverlap, OverlapOfTheOriginalIsNotNew) {
  const Painted folded = halves(8, 0.5F);
  const UvOverlap overlap = uv_overlap(folded.surface(), folded.surface());
  EXPECT_NEAR(overlap.original, 1.0, 3 * kTexel) << "all of it is used twice";
  EXPECT_EQ(overlap.original, overlap.second);
  EXPECT_EQ(overlap.added, 0.0);
  EXPECT_EQ(uv_overlap(folded.surface(), halves(8, 0.0F).surface()).second, 0.0);
}

TEST(UvOverlap, TexturesRepeat) {
  const auto shifted = [](float by) {
    return painted(grid(4), {.uv = [=](const glm::vec3& p, std::size_t face) {
                     const glm::vec2 uv = glm::vec2(p) / 8.0F;  // a quarter of the texture
                     return face % 8 >= 4 ? uv + glm::vec2(by, -3.0F) : uv;
                   }});
  };
  const UvOverlap once = uv_overlap(shifted(0.0F).surface(), shifted(5.0F).surface());
  EXPECT_EQ(once.added, 0.0) << "the same place of the texture";
  const UvOverlap twice = uv_overlap(shifted(0.0F).surface(), shifted(2.75F).surface());
  EXPECT_NEAR(twice.added, 1.0, 8 * kTexel) << "both halves are at one place";
}

TEST(UvOverlap, ImagesDoNotOverlap) {
  Painted two = halves(8, 0.5F);
  two.attributes.groups = named_groups({"left", "right"});
  for (std::uint32_t f = 0; f < two.mesh.face_count(); ++f)
    two.attributes.group.push_back(f % 16 >= 8 ? 1 : 0);
  two.textures = {{.image = 5}, {.image = 6}};
  const Painted apart = halves(8, 0.0F);
  EXPECT_EQ(uv_overlap(apart.surface(), two.surface()).second, 0.0);
  two.textures = {{.image = 5}, {.image = 5}};
  EXPECT_NEAR(uv_overlap(apart.surface(), two.surface()).second, 1.0, 3 * kTexel);
}

TEST(UvOverlap, TextureThatIsUsedManyTimesGetsACoarserGrid) {
  // Each face covers eight times eight repetitions.
  const Painted tiled = painted(
      grid(20), {.uv = [](const glm::vec3& p, std::size_t) { return 8.0F * glm::vec2(p); }});
  const UvOverlap overlap = uv_overlap(tiled.surface(), tiled.surface());
  EXPECT_NEAR(overlap.second, 20.0 * 20.0 * 64.0 - 1.0, 1e-6);
  EXPECT_EQ(overlap.added, 0.0);
}

TEST(UvOverlap, CoordinatesThatAreFarOffAreLeftOut) {
  const Painted sheet = halves(4, 0.0F);
  for (const float far : {1e9F, 1e30F}) {
    const Painted away = painted(grid(4), {.uv = [=](const glm::vec3& p, std::size_t face) {
                                   return face == 0 ? far * glm::vec2(p) : glm::vec2(far, 0.0F);
                                 }});
    EXPECT_FALSE(uv_overlap(sheet.surface(), away.surface()).is_measured);
  }
  EXPECT_FALSE(uv_overlap(sheet.surface(), painted(grid(2), {}).surface()).is_measured);
}

}  // namespace
}  // namespace mesher::test
