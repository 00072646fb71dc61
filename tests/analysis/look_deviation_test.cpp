#include "engine/analysis/look_deviation.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/analysis/color_difference.h"
#include "engine/analysis/normal_deviation.h"
#include "engine/core/error.h"
#include "tests/analysis/painted.h"

namespace mesher::test {
namespace {

Painted tilted(float deg) {
  return painted(grid(4), {.normal = [=](const glm::vec3&) {
                   return glm::vec3(std::sin(glm::radians(deg)), 0, std::cos(glm::radians(deg)));
                 }});
}

TEST(NormalDeviation, IsTheAngleOfTheNormals) {
  for (const float deg : {0.0F, 10.0F, 90.0F, 170.0F}) {
    const Painted a = tilted(0);
    const Painted b = tilted(deg);
    const analysis::Spread angles =
        analysis::normal_deviation(a.surface(), b.surface(), matches_of(a, b));
    EXPECT_NEAR(angles.mean(), double(deg), 1e-4);
    EXPECT_NEAR(angles.max(), double(deg), 1e-4);
  }
}

TEST(NormalDeviation, FacesCountWhereThereAreNoNormals) {
  const Painted plain = painted(grid(4), {});
  const Painted a = tilted(10);
  EXPECT_FALSE(analysis::ShadingNormals(plain.surface()).is_of_file());
  EXPECT_NEAR(analysis::normal_deviation(plain.surface(), a.surface(), matches_of(plain, a)).mean(),
              10.0, 1e-4);
  const Painted not_numbers =
      painted(grid(4), {.normal = [](const glm::vec3&) { return glm::vec3(kNoNumber); }});
  EXPECT_NEAR(
      analysis::normal_deviation(not_numbers.surface(), a.surface(), matches_of(not_numbers, a))
          .mean(),
      10.0, 1e-4);
}

TEST(NormalDeviation, HardEdgeIsNone) {
  const Painted box = painted(cube(), {});
  EXPECT_NEAR(analysis::normal_deviation(box.surface(), box.surface(), matches_of(box, box)).max(),
              0.0, 1e-4);
}

// Pairs from the test data of Sharma, Wu and Dalal.
TEST(DeltaE, AgreesWithPublishedPairs) {
  EXPECT_NEAR(analysis::delta_e_2000({50, 2.6772, -79.7751}, {50, 0, -82.7485}), 2.0425, 1e-4);
  EXPECT_NEAR(analysis::delta_e_2000({50, 2.8361, -74.0200}, {50, 0, -82.7485}), 3.4412, 1e-4);
  EXPECT_NEAR(analysis::delta_e_2000({50, 0, 0}, {50, -1, 2}), 2.3669, 1e-4);
  EXPECT_NEAR(analysis::delta_e_2000({50, 2.49, -0.001}, {50, -2.49, 0.0009}), 7.1792, 1e-4);
  EXPECT_NEAR(analysis::delta_e_2000({50, 2.49, -0.001}, {50, -2.49, 0.0011}), 7.2195, 1e-4);
  EXPECT_NEAR(analysis::delta_e_2000({50, 2.5, 0}, {61, -5, 29}), 22.8977, 1e-4);
  EXPECT_NEAR(analysis::delta_e_2000({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}),
              1.2644, 1e-4);
  EXPECT_NEAR(analysis::delta_e_2000({2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}), 0.9082,
              1e-4);
  EXPECT_EQ(analysis::delta_e_76({50, 3, 4}, {50, 0, 0}), 5.0);
}

TEST(LabOf, WhiteBlackAndRed) {
  EXPECT_NEAR(analysis::lab_of(glm::dvec3(1)).x, 100.0, 1e-3);
  EXPECT_NEAR(glm::length(analysis::lab_of(glm::dvec3(0))), 0.0, 1e-9);
  const glm::dvec3 red = analysis::lab_of({1, 0, 0});
  EXPECT_NEAR(red.x, 53.24, 0.01);
  EXPECT_NEAR(red.y, 80.09, 0.01);
  EXPECT_NEAR(red.z, 67.20, 0.01);
}

TEST(ColorDifference, IsThatOfTheColors) {
  const auto of_gray = [](std::uint8_t level) {
    return painted(grid(2), {.color = [=](const glm::vec3&) {
                     return glm::u8vec4(level, level, level, 255);
                   }});
  };
  const Painted white = of_gray(255);
  const Painted black = of_gray(0);
  const analysis::ColorDifference d =
      analysis::color_difference(white.surface(), black.surface(), matches_of(white, black));
  EXPECT_NEAR(d.cie76.mean(), 100.0, 1e-3);
  EXPECT_NEAR(d.ciede2000.mean(), 100.0, 1e-2);
  EXPECT_EQ(analysis::color_difference(white.surface(), white.surface(), matches_of(white, white))
                .cie76.max(),
            0.0);
}

TEST(LookDeviation, SaysWhatIsMissing) {
  const Painted plain = painted(grid(3), {});
  const Painted a = sheet_with(3, {});
  const analysis::LookDeviation look =
      analysis::look_deviation(a.surface(), plain.surface(), {.samples = 1000});
  EXPECT_FALSE(look.uv_slide || look.texture || look.stretch || look.flipped || look.colors);
  ASSERT_EQ(look.not_measured.size(), 2U);
  EXPECT_EQ(look.not_measured[0].what, "texture coordinates");
  EXPECT_EQ(look.not_measured[0].why, "the second model has no texture coordinates");
  EXPECT_EQ(look.not_measured[1].why, "the models have no vertex colors");
}

// A palette: each face has one point of the texture.
TEST(LookDeviation, TextureWithoutAreaIsNotStretched) {
  const auto palette = [](float u) {
    return painted(grid(3), {.uv = [=](const glm::vec3&, std::size_t) { return glm::vec2(u); }});
  };
  const Painted a = palette(0.25F);
  const Painted b = palette(0.5F);
  const analysis::LookDeviation look =
      analysis::look_deviation(a.surface(), b.surface(), {.samples = 1000});
  EXPECT_TRUE(look.uv_slide);
  EXPECT_FALSE(look.texture || look.stretch || look.flipped || look.overlap);
  EXPECT_EQ(look.not_measured.size(), 5U) << "and colors";
}

TEST(LookDeviation, OfItselfIsNothing) {
  const Painted a = painted(
      torus(20, 12),
      {.uv = [](const glm::vec3& p, std::size_t) { return glm::vec2(p.x + 0.3F * p.z, p.y); },
       .color = [](const glm::vec3& p) { return glm::u8vec4(40.0F * (p + 3.0F), 255); }});
  const analysis::LookDeviation look =
      analysis::look_deviation(a.surface(), a.surface(), {.samples = 5000});
  EXPECT_NEAR(look.normals->forward.max(), 0.0, 1e-3);
  EXPECT_LT(look.texture->forward.max(), 1e-4);
  EXPECT_LT(look.uv_slide->backward.max(), 1e-2);
  EXPECT_EQ(look.flipped->flipped, 0U);
  EXPECT_LT(look.colors->cie76.forward.max(), 1e-2);
  EXPECT_TRUE(look.not_measured.empty());
}

TEST(LookDeviation, StrangeInputIsMeasuredWithoutNumbers) {
  const glm::vec2 bad[] = {glm::vec2(kNoNumber), glm::vec2(1e38F), glm::vec2(0)};
  for (const glm::vec2& uv : bad) {
    const Painted a =
        painted(soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {0, 1, 2, 0, 2, 3}),
                {.uv = [=](const glm::vec3& p, std::size_t) { return uv * p.x; }});
    const analysis::LookDeviation look =
        analysis::look_deviation(a.surface(), a.surface(), {.samples = 500});
    EXPECT_TRUE(std::isfinite(look.normals->forward.mean()));
  }
}

TEST(LookDeviation, SurfacesWithoutAreaAreNotMeasured) {
  const Painted line =
      painted(soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2}),
              {.uv = [](const glm::vec3& p, std::size_t) { return glm::vec2(p); }});
  const analysis::LookDeviation look =
      analysis::look_deviation(line.surface(), line.surface(), {.samples = 100});
  EXPECT_FALSE(look.normals || look.texture || look.uv_slide || look.stretch || look.flipped);
}

TEST(LookDeviation, CancellationStops) {
  Progress progress;
  progress.cancel();
  const Painted a = sheet_with(4, {});
  EXPECT_THROW((void)analysis::look_deviation(a.surface(), a.surface(), {.progress = &progress}),
               Cancelled);
}

}  // namespace
}  // namespace mesher::test
