// Input as in real files: hubs, coordinates at the limits of floats, coincident points.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/mesh/corner_attributes.h"
#include "engine/simplify/simplify.h"
#include "engine/subdivide/attributes.h"
#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/limit.h"
#include "engine/subdivide/masks.h"
#include "engine/subdivide/refine.h"
#include "engine/subdivide/subdivide.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

/// A closed double cone: two apexes with `spokes` neighbors each.
Mesh double_cone(std::uint32_t spokes, float sharpness) {
  Soup soup;
  soup.positions = {{0, 0, 1.3F}, {0, 0, -0.7F}};
  for (std::uint32_t i = 0; i < spokes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / spokes;
    soup.positions.emplace_back(std::cos(angle), std::sin(angle), 0.3);
    const std::uint32_t here = 2 + i;
    const std::uint32_t next = 2 + (i + 1) % spokes;
    for (const std::uint32_t v : {0U, here, next, 1U, next, here})
      soup.corners.push_back(v);
    if (sharpness > 0.0F) soup.creases.push_back({0, here, sharpness});
  }
  return build_mesh(std::move(soup)).mesh;
}

constexpr subdivide::Scheme kSchemes[] = {subdivide::Scheme::loop, subdivide::Scheme::butterfly,
                                          subdivide::Scheme::midpoint};

// Walking around the whole hub for each of its edges would take ten minutes, which exceeds the time
// limit of ctest.
TEST(Degenerate, HubsWith100000SpokesTerminate) {
  constexpr std::uint32_t kSpokes = kSanitized ? 20'000 : 100'000;
  for (const float sharpness : {0.0F, 1.5F, kInfinitelySharp}) {
    const Mesh mesh = double_cone(kSpokes, sharpness);
    for (const subdivide::Scheme scheme : kSchemes) {
      for (const subdivide::CreaseDecay decay :
           {subdivide::CreaseDecay::uniform, subdivide::CreaseDecay::chaikin}) {
        const subdivide::SubdivideOptions options{.scheme = scheme,
                                                  .creases = subdivide::CreaseRules::derose98,
                                                  .decay = decay,
                                                  .limit = true};
        EXPECT_EQ(subdivide::subdivide(mesh, options).mesh.face_count(), 8 * kSpokes);
      }
    }
  }
}

TEST(Degenerate, HubsFollowTheirVertexMask) {
  for (const std::uint32_t spokes : {32U, 64U, 65U, 1000U, 30'000U}) {
    const Mesh mesh = double_cone(spokes, 0.0F);
    const subdivide::RingMask mask = subdivide::loop_vertex_mask(spokes);
    for (const unsigned threads : {1U, 2U}) {
      const ThreadLimit limit(threads);
      const Mesh fine = subdivide::subdivide(mesh, {}).mesh;
      EXPECT_NEAR(fine.position(Vertex(0)).z, mask.own * 1.3 + (1.0 - mask.own) * 0.3, 3e-7)
          << spokes;
    }
  }
}

TEST(Degenerate, ButterflyAtAHubFollowsItsStencil) {
  constexpr std::uint32_t kSpokes =
      40;  // above the limit from which stencils are evaluated together
  const Mesh mesh = double_cone(kSpokes, 0.0F);
  const Mesh fine = subdivide::subdivide(mesh, {.scheme = subdivide::Scheme::butterfly}).mesh;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.origin(Halfedge(h)) != Vertex(0)) continue;
    glm::dvec3 expected = subdivide::kButterflyCenter * glm::dvec3(mesh.position(Vertex(0)));
    Halfedge spoke(h);
    for (std::uint32_t i = 0; i < kSpokes; ++i) {
      expected += subdivide::butterfly_ring_weight(kSpokes, i) *
                  glm::dvec3(mesh.position(mesh.target(spoke)));
      spoke = mesh.rotate_ccw(spoke);
    }
    // The rim vertex has four neighbors, so it is extraordinary, too.
    const Halfedge back = mesh.twin(Halfedge(h));
    glm::dvec3 other = subdivide::kButterflyCenter * glm::dvec3(mesh.position(mesh.origin(back)));
    spoke = back;
    for (std::uint32_t i = 0; i < 4; ++i) {
      other +=
          subdivide::butterfly_ring_weight(4, i) * glm::dvec3(mesh.position(mesh.target(spoke)));
      spoke = mesh.rotate_ccw(spoke);
    }
    const Vertex made = fine.target(subdivide::first_half(Halfedge(h)));
    const glm::dvec3 point = fine.position(made);
    EXPECT_NEAR(glm::length(point - 0.5 * (expected + other)), 0.0, 1e-6);
  }
}

TEST(Degenerate, FixedVerticesKeepTheirExactPosition) {
  MeshArrays arrays = MeshArrays::take(double_cone(6, 0.0F));
  arrays.position[0].z = 3e38F;
  arrays.position[1] = {1.2345678F, 1e-3F, 1.1e-30F};
  const Mesh mesh = std::move(arrays).finish();
  for (const subdivide::SubdivideOptions& options :
       {subdivide::SubdivideOptions{.levels = 0},
        subdivide::SubdivideOptions{.scheme = subdivide::Scheme::butterfly},
        subdivide::SubdivideOptions{.levels = 2, .scheme = subdivide::Scheme::midpoint}}) {
    const Mesh fine = subdivide::subdivide(mesh, options).mesh;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
      EXPECT_EQ(fine.position(Vertex(v)), mesh.position(Vertex(v)));
  }
}

TEST(Degenerate, VertexTagDecaysUnderTheBoundaryRule) {
  Soup soup;
  soup.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  soup.corners = {0, 1, 2};
  soup.corner_tags = {{0, 2.5F}};
  const Mesh mesh = build_mesh(std::move(soup)).mesh;
  subdivide::SubdivideOptions options{.levels = 2,
                                      .boundary = subdivide::BoundaryRounding::edge_and_corner};
  const Mesh fine = subdivide::subdivide(mesh, options).mesh;
  EXPECT_EQ(fine.sharpness(Vertex(0)), 0.5F);
  EXPECT_EQ(fine.sharpness(Vertex(1)), 0.0F);
  options.levels = 3;
  EXPECT_EQ(subdivide::subdivide(mesh, options).mesh.sharpness(Vertex(0)), 0.0F);
}

TEST(Degenerate, EveryLongStepStopsWhenCanceled) {
  const Mesh mesh = double_cone(40, 2.0F);
  const subdivide::LevelView level = subdivide::view_of(mesh);
  Progress cancelled;
  cancelled.cancel();
  const subdivide::SubdivideOptions options{.progress = &cancelled};
  const subdivide::Features features = subdivide::features_of(mesh, options);
  const auto place = [](const subdivide::EdgeSite&) { return mesher::subdivide::Point(); };
  EXPECT_THROW(subdivide::refine(level, true, &cancelled, place), Cancelled);
  EXPECT_THROW(subdivide::limit_surface(level, features, options), Cancelled);
  CornerAttributes corners;
  corners.texcoord.assign(mesh.halfedge_count(), glm::vec2(0.0F));
  const Attributes attributes = to_wedges(mesh, std::move(corners));
  EXPECT_THROW(subdivide::subdivide_attributes(mesh, attributes, mesh, options), Cancelled);
  for (const unsigned threads : {1U, 2U}) {
    const ThreadLimit limit(threads);
    EXPECT_THROW(static_cast<void>(subdivide::subdivide(mesh, options)), Cancelled);
  }
}

TEST(Degenerate, PeakMemoryCountsSharpElements) {
  const subdivide::SubdivideOptions options{.levels = 2};
  const std::uint64_t smooth =
      subdivide::subdivision_size(double_cone(500, 0.0F), options).peak_bytes;
  const std::uint64_t creased =
      subdivide::subdivision_size(double_cone(500, 2.0F), options).peak_bytes;
  EXPECT_EQ(creased - smooth, subdivide::kBytesPerSharpEdge * (500 * 4 + 500 * 2));
}

TEST(Degenerate, ResultScalesUpToTheLimitsOfFloats) {
  const Mesh unit = double_cone(7, 2.0F);
  for (const int exponent : {-140, -120, 100, 126}) {
    MeshArrays arrays = MeshArrays::take(Mesh(unit));
    for (glm::vec3& p : arrays.position)
      p *= std::ldexp(1.0F, exponent);
    const Mesh mesh = std::move(arrays).finish();
    for (const subdivide::Scheme scheme : kSchemes) {
      for (const bool limit : {false, true}) {
        const subdivide::SubdivideOptions options{.levels = 2, .scheme = scheme, .limit = limit};
        const Mesh expected = subdivide::subdivide(unit, options).mesh;
        const Mesh result = subdivide::subdivide(mesh, options).mesh;
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

TEST(Degenerate, LargestCoordinatesStayFinite) {
  MeshArrays arrays = MeshArrays::take(double_cone(6, 0.0F));
  for (glm::vec3& p : arrays.position)
    p *= 0.75F * std::numeric_limits<float>::max();
  const Mesh mesh = std::move(arrays).finish();
  for (const subdivide::Scheme scheme : kSchemes)
    expect_valid(subdivide::subdivide(mesh, {.levels = 3, .scheme = scheme, .limit = true}).mesh);
}

/// Tags edges and vertices at random.
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

subdivide::SubdivideOptions options_at_random(std::uint32_t seed) {
  std::mt19937 random(seed + 1);
  return {.levels = static_cast<std::uint32_t>(random() % 3),
          .scheme = kSchemes[random() % 3],
          .creases = static_cast<subdivide::CreaseRules>(random() % 2),
          .boundary = static_cast<subdivide::BoundaryRounding>(random() % 2),
          .decay = static_cast<subdivide::CreaseDecay>(random() % 2),
          .limit = random() % 2 == 0};
}

TEST(Degenerate, SubdivideSimplifySubdivideKeepsMeshesValid) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Mesh mesh = build_mesh(random_soup(seed)).mesh;
    tag_at_random(mesh, seed);
    const subdivide::Subdivided fine = subdivide::subdivide(mesh, options_at_random(seed));
    expect_valid(fine.mesh);
    for (const glm::vec3& normal : fine.limit_normal)
      ASSERT_TRUE(std::isfinite(normal.x + normal.y + normal.z));
    Mesh coarse =
        simplify::simplify(Mesh(fine.mesh), {.target_faces = fine.mesh.face_count() / 3}).mesh;
    expect_valid(coarse);
    expect_valid(subdivide::subdivide(coarse, options_at_random(seed + 1000)).mesh);
  }
}

TEST(Degenerate, CoincidentPointsStayCoincident) {
  MeshArrays arrays = MeshArrays::take(double_cone(5, 1.0F));
  for (glm::vec3& p : arrays.position)
    p = {3.0F, -2.0F, 0.5F};
  const Mesh mesh = std::move(arrays).finish();
  for (const subdivide::Scheme scheme : kSchemes) {
    const Mesh result =
        subdivide::subdivide(mesh, {.levels = 2, .scheme = scheme, .limit = true}).mesh;
    expect_valid(result);
    for (const glm::vec3& p : result.positions()) {
      EXPECT_NEAR(p.x, 3.0F, 1e-6F);
      EXPECT_NEAR(p.y, -2.0F, 1e-6F);
    }
  }
}

}  // namespace
}  // namespace mesher::test
