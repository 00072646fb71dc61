// Tests the measures of texture coordinates against answers that are known.
#include <cmath>

#include "engine/analysis/flipped_uvs.h"
#include "engine/analysis/texture_deviation.h"
#include "engine/analysis/uv_slide.h"
#include "engine/analysis/uv_stretch.h"
#include "tests/analysis/painted.h"
#include "tests/support/attributes.h"

namespace mesher::test {
namespace {

using analysis::Reference;

analysis::Spread slide_of(const Painted& a, const Painted& b) {
  return analysis::uv_slide(a.surface(), b.surface(), matches_of(a, b), Reference::from);
}

TEST(UvSlide, ShiftOfTexelsIsTheSlide) {
  const Painted a = sheet_with(4, {}, 0.25F);
  for (const float texels : {0.0F, 1.0F, 7.5F}) {
    const analysis::Spread slide = slide_of(a, sheet_with(3 + 1, {texels / 1024.0F, 0}, 0.25F));
    EXPECT_NEAR(slide.percentile(0.5), double(texels), 1e-3);
    EXPECT_NEAR(slide.percentile(0.99), double(texels), 1e-3);
    EXPECT_NEAR(slide.percentile(0.0), double(texels), 1e-3);
  }
}

TEST(UvSlide, TexelsAreThoseOfTheReference) {
  Painted a = sheet_with(2, {});
  Painted b = sheet_with(2, {0.5F, 0.25F});
  a.attributes.group.assign(a.mesh.face_count(), 0);
  a.attributes.groups = named_groups({"a"});
  a.textures = {{.set = 0, .texels = {64.0, 32.0}}};
  const double expected = std::hypot(32.0, 8.0);
  EXPECT_NEAR(slide_of(a, b).max(), expected, 1e-4);
  const analysis::Spread backward =
      analysis::uv_slide(b.surface(), a.surface(), matches_of(b, a), Reference::to);
  EXPECT_NEAR(backward.max(), expected, 1e-4);
}

// The left and the right half of the sheet are different charts.
glm::vec2 two_charts(const glm::vec3& p, std::size_t face, std::size_t faces_per_row) {
  return glm::vec2(p) + (face % faces_per_row < faces_per_row / 2 ? glm::vec2(0) : glm::vec2(50));
}

TEST(UvSlide, SeamIsNoSlide) {
  const auto with_seam = [](std::uint32_t n) {
    return painted(grid(n), {.uv = [=](const glm::vec3& p, std::size_t face) {
                     return two_charts(p, face, std::size_t{2} * n);
                   }});
  };
  const Painted a = with_seam(4);
  EXPECT_TRUE(a.attributes.has_seams());
  EXPECT_LT(slide_of(a, a).max(), 0.02);
  // All samples lie on the seam.
  const Painted above =
      painted(soup_of({{2, 0, 0}, {2, 4, 0}, {2, 4, 1}}, {0, 1, 2}),
              {.uv = [](const glm::vec3& p, std::size_t) { return glm::vec2(p) + glm::vec2(50); }});
  EXPECT_LT(slide_of(above, a).max(), 0.02);
}

TEST(UvSlide, MissingCoordinatesAreLeftOut) {
  const Painted a = sheet_with(2, {});
  Painted none =
      painted(grid(2), {.uv = [](const glm::vec3&, std::size_t) { return glm::vec2(kNoNumber); }});
  EXPECT_TRUE(slide_of(a, none).is_empty());
  EXPECT_TRUE(slide_of(none, a).is_empty());
  none.attributes = {};
  EXPECT_TRUE(analysis::UvLayers(none.surface()).is_empty());
  EXPECT_TRUE(slide_of(a, none).is_empty());
}

TEST(UvLayers, CountFromTheTop) {
  Painted a = sheet_with(1, {});
  EXPECT_NEAR(analysis::UvLayers(a.surface()).at({Face(0), {1, 0, 0}})->y, 1.0, 1e-6);
  AttributeType type = texcoord_type();
  type.counts_down = true;
  const AttributeLayer up = a.attributes.layers[0];
  a.attributes.layers[0] = AttributeLayer(type, up.values<glm::vec2>());
  EXPECT_NEAR(analysis::UvLayers(a.surface()).at({Face(0), {1, 0, 0}})->y, 0.0, 1e-6);
}

analysis::TextureDeviation deviation(const Painted& from, const Painted& to) {
  return analysis::texture_deviation(from.surface(), analysis::UvTree(to.surface()),
                                     matches_of(from, to));
}

TEST(TextureDeviation, IsTheDistanceOfEqualCoordinates) {
  const Painted a = sheet_with(4, {});
  // Moved up by 0.5, and the texture along x by 0.25.
  Soup moved = grid(4);
  for (glm::vec3& p : moved.positions)
    p.z = 0.5F;
  const Painted b = painted(std::move(moved), {.uv = [](const glm::vec3& p, std::size_t) {
                              return glm::vec2(p) + glm::vec2(0.25F, 0.0F);
                            }});
  const analysis::TextureDeviation d = deviation(a, b);
  EXPECT_NEAR(d.distances.rms(), std::hypot(0.5, 0.25), 1e-5);
  EXPECT_NEAR(d.distances.max(), std::hypot(0.5, 0.25), 1e-5);
  EXPECT_NEAR(d.covered, 15.0 / 16.0, 0.01);
}

TEST(TextureDeviation, OfItselfIsZero) {
  const Painted a = painted(torus(20, 12), {.uv = [](const glm::vec3& p, std::size_t) {
                              return glm::vec2(p.x + 0.3F * p.z, p.y);
                            }});
  const analysis::TextureDeviation d = deviation(a, a);
  EXPECT_LT(d.distances.max(), 1e-4);
  EXPECT_EQ(d.covered, 1.0);
}

// Top and bottom of the sheet have the same texture: the nearer one counts.
TEST(TextureDeviation, OverlappingChartsCountByTheNearest) {
  Soup two = grid(3);
  for (glm::vec3 p : grid(3).positions)
    two.positions.push_back(p + glm::vec3(0, 0, 10));
  const std::size_t corners = two.corners.size();
  for (std::size_t i = 0; i < corners; ++i)
    two.corners.push_back(two.corners[i] + 16);
  const Painted a =
      painted(two, {.uv = [](const glm::vec3& p, std::size_t) { return glm::vec2(p); }});
  EXPECT_LT(deviation(a, a).distances.max(), 1e-4);
  const analysis::TextureDeviation one = deviation(a, sheet_with(3, {}));
  EXPECT_NEAR(one.distances.max(), 10.0, 1e-4);
  EXPECT_NEAR(one.distances.percentile(0.25), 0.0, 1e-4);
}

TEST(TextureDeviation, FacesOfOneColorCountAsAWhole) {
  const auto all_at = [](const glm::vec2& uv) {
    return painted(grid(3), {.uv = [=](const glm::vec3&, std::size_t) { return uv; }});
  };
  const analysis::TextureDeviation same = deviation(all_at({0.5F, 0.5F}), all_at({0.5F, 0.5F}));
  EXPECT_LT(same.distances.max(), 1e-4);
  EXPECT_EQ(same.covered, 1.0);
  EXPECT_EQ(deviation(all_at({0.5F, 0.5F}), all_at({0.75F, 0.5F})).covered, 0.0);
}

TEST(TextureDeviation, FacesOfAnotherColorDoNotCount) {
  // The left half has one color, the right half another; in `b` they are exchanged.
  const auto halves = [](float left, float right) {
    return painted(grid(2), {.uv = [=](const glm::vec3&, std::size_t face) {
                     return glm::vec2(face % 4 < 2 ? left : right, 0.5F);
                   }});
  };
  const analysis::TextureDeviation d = deviation(halves(0.25F, 0.75F), halves(0.75F, 0.25F));
  EXPECT_NEAR(d.distances.mean(), 0.5, 0.02);
  EXPECT_EQ(d.covered, 1.0);
}

TEST(TextureDeviation, TextureOfOneLineIsMeasuredAcrossFaces) {
  const auto along_x = [](float shift) {
    return painted(grid(4), {.uv = [=](const glm::vec3& p, std::size_t) {
                     return glm::vec2(p.x + shift, 0.0F);
                   }});
  };
  EXPECT_LT(deviation(along_x(0), along_x(0)).distances.max(), 1e-4);
  EXPECT_NEAR(deviation(along_x(0), along_x(0.5F)).distances.rms(), 0.5, 1e-4);
}

TEST(TextureDeviation, SurfaceWithoutCoordinatesIsNotCovered) {
  const Painted none = painted(grid(2), {});
  const analysis::TextureDeviation d = deviation(sheet_with(2, {}), none);
  EXPECT_TRUE(d.distances.is_empty());
  EXPECT_EQ(d.covered, 0.0);
}

TEST(UvStretch, OfItselfIsOne) {
  const Painted a = painted(torus(20, 12), {.uv = [](const glm::vec3& p, std::size_t) {
                              return glm::vec2(p.x + 0.3F * p.z, p.y);
                            }});
  const analysis::UvStretch s = analysis::uv_stretch(a.surface(), a.surface(), matches_of(a, a));
  EXPECT_NEAR(s.mean.rms(), 1.0, 1e-5);
  EXPECT_NEAR(s.worst.max(), 1.0, 1e-2);
}

TEST(UvStretch, IsLengthPerTexture) {
  const Painted a = sheet_with(4, {});
  const Painted twice = sheet_with(4, {}, 0.5F);  // the texture lies twice as wide
  const analysis::UvStretch wide =
      analysis::uv_stretch(a.surface(), twice.surface(), matches_of(twice, a));
  EXPECT_NEAR(wide.mean.rms(), 2.0, 1e-5);
  EXPECT_NEAR(wide.worst.max(), 2.0, 1e-5);
  const Painted one_way = painted(
      grid(4), {.uv = [](const glm::vec3& p, std::size_t) { return glm::vec2(0.25F * p.x, p.y); }});
  const analysis::UvStretch along =
      analysis::uv_stretch(a.surface(), one_way.surface(), matches_of(one_way, a));
  EXPECT_NEAR(along.mean.rms(), std::sqrt((16.0 + 1.0) / 2.0), 1e-5);
  EXPECT_NEAR(along.worst.max(), 4.0, 1e-5);
}

TEST(UvStretch, TextureWithoutAreaIsLeftOut) {
  const Painted flat = painted(
      grid(2), {.uv = [](const glm::vec3& p, std::size_t) { return glm::vec2(p.x, 0.0F); }});
  const Painted a = sheet_with(2, {});
  EXPECT_TRUE(
      analysis::uv_stretch(a.surface(), flat.surface(), matches_of(flat, a)).mean.is_empty());
  EXPECT_TRUE(
      analysis::uv_stretch(flat.surface(), a.surface(), matches_of(a, flat)).mean.is_empty());
}

analysis::FlippedUvs flips(const Painted& original, const Painted& other) {
  return analysis::flipped_uvs(original.surface(), analysis::TriangleTree(original.mesh),
                               other.surface());
}

TEST(FlippedUvs, TurnedTriangleIsCounted) {
  const Painted a = sheet_with(3, {});
  EXPECT_EQ(flips(a, a).flipped, 0U);
  EXPECT_EQ(flips(a, a).compared, 18U);
  const Painted turned = painted(grid(3), {.uv = [](const glm::vec3& p, std::size_t face) {
                                   return face == 5 ? glm::vec2(-p.x, p.y) : glm::vec2(p);
                                 }});
  const analysis::FlippedUvs found = flips(a, turned);
  EXPECT_EQ(found.flipped, 1U);
  EXPECT_EQ(found.compared, 18U);
  EXPECT_NEAR(found.flipped_area / found.compared_area, 1.0 / 18.0, 1e-6);
}

TEST(FlippedUvs, MirroredChartsOfTheOriginalAreNone) {
  const auto mirrored = [](std::uint32_t n) {
    return painted(grid(n), {.uv = [=](const glm::vec3& p, std::size_t) {
                     return glm::vec2(std::abs(p.x - 2.0F), p.y);
                   }});
  };
  EXPECT_EQ(flips(mirrored(4), mirrored(4)).flipped, 0U);
  EXPECT_EQ(flips(sheet_with(4, {}), mirrored(4)).flipped, 16U) << "half is mirrored only here";
}

TEST(FlippedUvs, SecondSideIsNotCompared) {
  Soup turned = grid(3);
  for (std::size_t i = 0; i < turned.corners.size(); i += 3)
    std::swap(turned.corners[i + 1], turned.corners[i + 2]);
  const Painted back = painted(
      std::move(turned), {.uv = [](const glm::vec3& p, std::size_t) { return glm::vec2(p); }});
  EXPECT_EQ(flips(sheet_with(3, {}), back).compared, 0U);
}

}  // namespace
}  // namespace mesher::test
