// What real files bring: hubs, coordinates at the ends of what floats hold, points on one place.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "engine/simplify/simplify.h"
#include "engine/subdivide/subdivide.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// A closed double cone: two tips with `spokes` neighbours each.
Mesh double_cone(std::uint32_t spokes, float sharpness) {
  Soup soup;
  soup.positions = {{0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < spokes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / spokes;
    soup.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    const std::uint32_t here = 2 + i;
    const std::uint32_t next = 2 + (i + 1) % spokes;
    for (const std::uint32_t v : {0U, here, next, 1U, next, here})
      soup.corners.push_back(v);
    if (sharpness > 0.0F) soup.creases.push_back({0, here, sharpness});
  }
  return build_mesh(std::move(soup)).mesh;
}

constexpr Scheme kSchemes[] = {Scheme::loop, Scheme::butterfly, Scheme::midpoint};

TEST(Degenerate, HubsTakeTimeInProportion) {
  constexpr std::uint32_t kSpokes = 20'000;
  for (const float sharpness : {0.0F, 1.5F, kInfinitelySharp}) {
    const Mesh mesh = double_cone(kSpokes, sharpness);
    for (const CreaseDecay decay : {CreaseDecay::uniform, CreaseDecay::chaikin}) {
      const Subdivided result = subdivide(
          mesh, {.levels = 2, .creases = CreaseRules::derose98, .decay = decay, .limit = true});
      EXPECT_EQ(result.mesh.face_count(), 32 * kSpokes);
      // On the axis, as long as nothing is broken.
      EXPECT_NEAR(result.mesh.position(Vertex(0)).x, 0.0F, 1e-3F);
      EXPECT_GT(result.mesh.position(Vertex(0)).z, -1e-3F);
    }
  }
}

TEST(Degenerate, SizesNearTheEndOfFloatsScale) {
  const Mesh unit = double_cone(7, 2.0F);
  for (const int exponent : {-140, -120, 100, 126}) {
    MeshArrays arrays = MeshArrays::take(Mesh(unit));
    for (glm::vec3& p : arrays.position)
      p *= std::ldexp(1.0F, exponent);
    const Mesh mesh = std::move(arrays).finish();
    for (const Scheme scheme : kSchemes) {
      for (const bool limit : {false, true}) {
        const SubdivideOptions options{.levels = 2, .scheme = scheme, .limit = limit};
        const Mesh expected = subdivide(unit, options).mesh;
        const Mesh result = subdivide(mesh, options).mesh;
        expect_valid(result);
        ASSERT_EQ(result.vertex_count(), expected.vertex_count());
        const float tolerance = std::max(std::ldexp(1e-6F, exponent), 1e-44F);
        for (std::uint32_t v = 0; v < result.vertex_count(); ++v) {
          const glm::vec3 p = result.position(Vertex(v));
          const glm::vec3 q = expected.position(Vertex(v));
          for (int i = 0; i < 3; ++i)
            ASSERT_NEAR(p[i], std::ldexp(q[i], exponent), tolerance) << exponent;
        }
      }
    }
  }
}

TEST(Degenerate, TheLargestCoordinatesStayNumbers) {
  MeshArrays arrays = MeshArrays::take(double_cone(6, 0.0F));
  for (glm::vec3& p : arrays.position)
    p *= std::numeric_limits<float>::max();
  const Mesh mesh = std::move(arrays).finish();
  for (const Scheme scheme : kSchemes)
    expect_valid(subdivide(mesh, {.levels = 3, .scheme = scheme, .limit = true}).mesh);
}

/// Tags whatever there is, at random.
void tag_at_random(Mesh& mesh, std::uint32_t seed) {
  std::mt19937 random(seed);
  constexpr float kSharpness[] = {0.0F, 0.0F, 0.5F, 1.0F, 2.7F, 11.0F, kInfinitelySharp};
  const auto any = [&] { return kSharpness[random() % std::size(kSharpness)]; };
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.edge(Halfedge(h)).index() == h) mesh.set_sharpness(Edge(h), any());
  }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (random() % 4 == 0) mesh.set_sharpness(Vertex(v), any());
  }
}

SubdivideOptions options_at_random(std::uint32_t seed) {
  std::mt19937 random(seed + 1);
  return {.levels = static_cast<std::uint32_t>(random() % 3),
          .scheme = kSchemes[random() % 3],
          .creases = static_cast<CreaseRules>(random() % 2),
          .boundary = static_cast<BoundaryRounding>(random() % 2),
          .decay = static_cast<CreaseDecay>(random() % 2),
          .limit = random() % 2 == 0};
}

TEST(Degenerate, AnythingMayBeSubdividedSimplifiedAndSubdividedAgain) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Mesh mesh = build_mesh(random_soup(seed)).mesh;
    tag_at_random(mesh, seed);
    const Subdivided fine = subdivide(mesh, options_at_random(seed));
    expect_valid(fine.mesh);
    for (const glm::vec3& normal : fine.limit_normal)
      ASSERT_TRUE(std::isfinite(normal.x + normal.y + normal.z));
    Mesh coarse = simplify(Mesh(fine.mesh), {.target_faces = fine.mesh.face_count() / 3}).mesh;
    expect_valid(coarse);
    expect_valid(subdivide(coarse, options_at_random(seed + 1000)).mesh);
  }
}

TEST(Degenerate, PointsOnOnePlaceStayThere) {
  MeshArrays arrays = MeshArrays::take(double_cone(5, 1.0F));
  for (glm::vec3& p : arrays.position)
    p = {3.0F, -2.0F, 0.5F};
  const Mesh mesh = std::move(arrays).finish();
  for (const Scheme scheme : kSchemes) {
    const Mesh result = subdivide(mesh, {.levels = 2, .scheme = scheme, .limit = true}).mesh;
    expect_valid(result);
    for (const glm::vec3& p : result.positions()) {
      EXPECT_NEAR(p.x, 3.0F, 1e-6F);
      EXPECT_NEAR(p.y, -2.0F, 1e-6F);
    }
  }
}

}  // namespace
}  // namespace mesher::test
