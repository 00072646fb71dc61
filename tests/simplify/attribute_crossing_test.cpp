#include <gtest/gtest.h>

#include <algorithm>

#include "engine/analysis/distance.h"
#include "engine/core/parallel.h"
#include "engine/mesh/corner_attributes.h"
#include "engine/mesh/validate.h"
#include "engine/mesh/wedges.h"
#include "engine/simplify/simplify_model.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using simplify::SimplifiedModel;

/// A checkerboard of 4 x 4 charts. All have the same texture, but that of every second one is 10
/// units away. Along the seams, 32 faces are the fewest.
struct Checkerboard {
  static constexpr std::uint32_t kSide = 12;
  static constexpr float kAway = 10.0F;

  static glm::vec2 texcoord_at(const glm::vec3& p) {
    return {0.25F * p.x - 0.5F * p.y, 3.0F + 0.125F * p.y};
  }

  Checkerboard() : mesh(built(grid(kSide)).mesh) {
    CornerAttributes corners;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      glm::vec3 sum(0.0F);
      for (std::uint32_t c = 0; c < 3; ++c)
        sum += mesh.position(mesh.origin(Halfedge(3 * f + c)));
      const int chart = static_cast<int>(sum.x / 9.0F) + static_cast<int>(sum.y / 9.0F);
      const float away = chart % 2 == 0 ? 0.0F : kAway;
      for (std::uint32_t c = 0; c < 3; ++c) {
        corners.texcoord.push_back(texcoord_at(mesh.position(mesh.origin(Halfedge(3 * f + c)))) +
                                   glm::vec2(away, 0.0F));
      }
    }
    attributes = to_wedges(mesh, std::move(corners));
  }
  SimplifiedModel simplified(std::uint32_t target) const {
    return simplify::simplify_model(Mesh(mesh), attributes, {.target_faces = target});
  }

  Mesh mesh;
  Attributes attributes;
};

TEST(CrossSeams, TextureStaysInPlaceOnBothSides) {
  const Checkerboard sheet;
  constexpr float kRounding = 2e-3F;  // of extended values; a slide would be 0.25 or more
  for (const std::uint32_t target : {24U, 12U, 6U}) {
    const SimplifiedModel model = sheet.simplified(target);
    const Mesh& mesh = model.simplified.mesh;
    EXPECT_TRUE(validate(mesh).empty());
    EXPECT_TRUE(validate(mesh, model.attributes).empty());
    EXPECT_TRUE(model.crosses_seams);
    ASSERT_LE(mesh.face_count(), target);
    const CornerAttributes carried = to_corners(mesh, model.attributes);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      float away[3];
      for (std::uint32_t c = 0; c < 3; ++c) {
        const glm::vec2 expected =
            Checkerboard::texcoord_at(mesh.position(mesh.origin(Halfedge(3 * f + c))));
        away[c] = carried.texcoord[3 * f + c].x - expected.x;
        EXPECT_NEAR(carried.texcoord[3 * f + c].y, expected.y, kRounding) << f;
        EXPECT_NEAR(away[c], away[0], kRounding) << "a face shows one chart only";
      }
      EXPECT_NEAR(std::min(std::abs(away[0]), std::abs(away[0] - Checkerboard::kAway)), 0.0F,
                  kRounding);
    }
  }
}

TEST(CrossSeams, IsTheLastResortOnAPlane) {
  // Every other collapse on a plane is free.
  EXPECT_FALSE(Checkerboard().simplified(100).crosses_seams);
}

TEST(CrossSeams, LockedBoundariesStayForEveryCost) {
  const Checkerboard sheet;
  for (const auto& [cost, text] : simplify::kCostPolicies) {
    const SimplifiedModel model = simplify::simplify_model(
        Mesh(sheet.mesh), sheet.attributes,
        {.target_faces = 20, .cost = cost, .boundary = simplify::BoundaryRule::lock});
    const Mesh& mesh = model.simplified.mesh;
    EXPECT_TRUE(validate(mesh).empty());
    std::uint32_t on_boundary = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
      on_boundary += mesh.is_boundary(Vertex(v)) ? 1U : 0U;
    EXPECT_EQ(on_boundary, 4 * Checkerboard::kSide) << text.key;
  }
}

TEST(CrossSeams, FewFacesAreAsCloseAsWithoutSeams) {
  // A torus of 20 x 10 charts: at 96 faces, no vertex can stay on a seam.
  const Mesh mesh = built(torus(60, 30)).mesh;
  CornerAttributes corners;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t quad = f / 2;
    const glm::vec2 chart(float(quad / 30 / 3), float(quad % 30 / 3));
    for (std::uint32_t c = 0; c < 3; ++c) {
      const glm::vec3 p = mesh.position(mesh.origin(Halfedge(3 * f + c)));
      corners.texcoord.push_back(2.0F * chart + 0.1F * glm::vec2(p.x + p.z, p.y - p.z));
    }
  }
  const Attributes attributes = to_wedges(mesh, std::move(corners));
  ASSERT_TRUE(attributes.has_seams());
  const auto rms_of = [&](const Attributes& with) {
    const SimplifiedModel model = simplify::simplify_model(Mesh(mesh), with, {.target_faces = 96});
    EXPECT_TRUE(validate(model.simplified.mesh).empty());
    EXPECT_TRUE(validate(model.simplified.mesh, model.attributes).empty());
    EXPECT_EQ(model.simplified.mesh.face_count(), 96U);
    return analysis::surface_distance(mesh, model.simplified.mesh, {.samples = 20'000})
        .two_sided()
        .rms;
  };
  EXPECT_LT(rms_of(attributes), 1.35 * rms_of({}));
}

TEST(CrossSeams, NeverWithoutATarget) {
  EXPECT_FALSE(Checkerboard().simplified(0).crosses_seams);
}

TEST(CrossSeams, SameBytesForAnyNumberOfThreads) {
  const Checkerboard sheet;
  const auto texcoords = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    const SimplifiedModel model = sheet.simplified(20);
    return to_corners(model.simplified.mesh, model.attributes).texcoord;
  };
  EXPECT_TRUE(std::ranges::equal(texcoords(1), texcoords(3)));
}

}  // namespace
}  // namespace mesher::test
