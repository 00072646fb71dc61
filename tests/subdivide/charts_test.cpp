#include "engine/subdivide/charts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/mesh/corner_attributes.h"
#include "engine/subdivide/attributes.h"
#include "engine/subdivide/subdivide.h"
#include "tests/subdivide/compare.h"
#include "tests/subdivide/models.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

using Texcoords = Array<glm::vec2>;  ///< one per corner

/// Returns a value per corner, of its vertex and its face.
template <class Value>
Texcoords texcoords(const Mesh& mesh, const Value& value) {
  Texcoords result;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    result.push_back(value(mesh.position(mesh.origin(Halfedge(h))), h / 3));
  return result;
}

Texcoords charts(const Mesh& mesh, const Texcoords& texcoord,
                 const subdivide::SubdivideOptions& options) {
  CornerAttributes corners;
  corners.texcoord = texcoord;
  const Attributes attributes = to_wedges(mesh, std::move(corners));
  const AttributeLayer fine =
      subdivide::subdivide_charts(mesh, attributes, attributes.layers.front(), options);
  const auto values = fine.values<glm::vec2>();
  return {values.begin(), values.end()};
}

Mesh sheet() {
  return built(grid(6)).mesh;
}

TEST(Charts, ConstantsAreReproduced) {
  const glm::vec2 value(0.25F, 0.75F);
  for (const subdivide::SubdivideOptions& options : every_rule(2)) {
    for (const Model& model : models()) {
      if (model.mesh.face_count() > 100) continue;
      SCOPED_TRACE(model.name);
      const Texcoords flat = texcoords(model.mesh, [&](const auto&, std::size_t) { return value; });
      for (const glm::vec2& fine : charts(model.mesh, flat, options))
        EXPECT_LT(glm::distance(fine, value), 1e-6F);
    }
  }
}

// The positions of a flat sheet are in its plane, so an affine function of them is one of the
// result's positions: the texture does not move on the surface. At the corners, texture coordinates
// stay as positions by `edge_and_corner` do.
TEST(Charts, LinearFunctionsOfThePlaneAreReproduced) {
  const Mesh mesh = sheet();
  const auto affine = [](const glm::vec3& p, std::size_t) {
    return glm::vec2(0.25F * p.x - 0.5F * p.y + 0.125F, 0.75F * p.y + 0.5F);
  };
  for (subdivide::SubdivideOptions options : every_rule(2)) {
    options.creases = subdivide::CreaseRules::derose98;
    options.boundary = subdivide::BoundaryRounding::edge_and_corner;
    for (const bool limit : {false, true}) {
      options.limit = limit;
      Mesh fine = subdivide::subdivide(mesh, options).mesh;
      const Texcoords result = charts(mesh, texcoords(mesh, affine), options);
      for (std::uint32_t h = 0; h < fine.halfedge_count(); ++h) {
        const glm::vec2 expected = affine(fine.position(fine.origin(Halfedge(h))), 0);
        // A corner of two faces stays in the chart only if the positions' rule pins it, too.
        const glm::vec3 p = mesh.position(Vertex(0));
        if (glm::distance(fine.position(fine.origin(Halfedge(h))), p) < 2.0F) continue;
        EXPECT_LT(glm::distance(result[h], expected), 1e-5F) << h;
      }
    }
  }
}

TEST(Charts, LoopMasksApplyInsideAChart) {
  const Mesh mesh = sheet();
  // One vertex inside has another value than all others.
  const auto spike = [](const glm::vec3& p, std::size_t) {
    return p == glm::vec3(3, 3, 0) ? glm::vec2(1, 2) : glm::vec2(0);
  };
  const Texcoords fine = charts(mesh, texcoords(mesh, spike), {.levels = 1});
  const auto expect_at = [&](const glm::vec3& from, const glm::vec3& to, float weight) {
    bool is_found = false;
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      const Halfedge half(h);
      if (mesh.position(mesh.origin(half)) != from || mesh.position(mesh.target(half)) != to)
        continue;
      is_found = true;
      // In the child of the corner: the corner itself, and the middle of its edge.
      const std::size_t child = 12 * (h / 3) + 3 * (h % 3);
      const std::size_t at = from == to ? child + h % 3 : child + (h % 3 + 1) % 3;
      EXPECT_LT(glm::distance(fine[at], weight * glm::vec2(1, 2)), 1e-6F);
    }
    EXPECT_TRUE(is_found);
  };
  expect_at({3, 3, 0}, {4, 3, 0}, 3.0F / 8.0F);
  expect_at({4, 3, 0}, {4, 4, 0}, 1.0F / 8.0F);
  expect_at({4, 4, 0}, {5, 5, 0}, 0.0F);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.position(mesh.origin(Halfedge(h))) == glm::vec3(3, 3, 0)) {
      EXPECT_LT(glm::distance(fine[12 * (h / 3) + 4 * (h % 3)], 0.625F * glm::vec2(1, 2)), 1e-6F);
    }
  }
}

/// Moves the values of the faces right of x = 3, on a sheet of 6 x 6 squares, by this much.
Texcoords cut_sheet(const Mesh& mesh, const glm::vec2& by) {
  return texcoords(mesh, [&](const glm::vec3& p, std::size_t face) {
    const bool is_right = face / 2 % 6 >= 3;
    return glm::vec2(p) + glm::vec2(0.1F * p.y * p.y, 0) + (is_right ? by : glm::vec2(0));
  });
}

TEST(Charts, BothSidesOfASeamStayAlike) {
  const Mesh mesh = sheet();
  for (subdivide::SubdivideOptions options : every_rule(3)) {
    for (const bool limit : {false, true}) {
      options.limit = limit;
      const Mesh fine = subdivide::subdivide(mesh, options).mesh;
      const glm::vec2 by(8, 4);
      const Texcoords result = charts(mesh, cut_sheet(mesh, by), options);
      std::uint32_t at_seam = 0;
      for (std::uint32_t i = 0; i < fine.halfedge_count(); ++i) {
        const Halfedge h(i);
        const Halfedge twin = fine.twin(h);
        if (!twin.is_valid()) continue;
        const auto is_right = [&](Halfedge half) {
          return half.index() / (3 * 64) / 2 % 6 >= 3 ? 1.0F : 0.0F;
        };
        const float step = is_right(twin) - is_right(h);
        at_seam += step == 0.0F ? 0 : 1;
        EXPECT_LT(glm::distance(result[Mesh::next(twin).index()], result[i] + step * by), 1e-5F);
      }
      EXPECT_EQ(at_seam, 2U * 6U * 8U);
    }
  }
}

TEST(Charts, SeamsAreSmoothCurvesOfTheirOwn) {
  const Mesh mesh = sheet();
  const Texcoords before = cut_sheet(mesh, {8, 0});
  const Texcoords fine = charts(mesh, before, {.levels = 1});
  // The vertex (3, 2), on the left: 3/4 of itself, 1/8 of its neighbors on the seam.
  const auto at = [](float y) { return glm::vec2(3 + 0.1F * y * y, y); };
  const glm::vec2 expected = 0.75F * at(2) + 0.125F * (at(1) + at(3));
  std::uint32_t found = 0;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    if (mesh.position(mesh.origin(Halfedge(h))) != glm::vec3(3, 2, 0) || h / 6 % 6 >= 3) continue;
    EXPECT_LT(glm::distance(fine[12 * (h / 3) + 4 * (h % 3)], expected), 1e-5F);
    ++found;
  }
  EXPECT_EQ(found, 3U);
}

TEST(Charts, CornersDartsAndJunctionsKeepTheirValues) {
  const Mesh mesh = sheet();
  // A seam along x = 3 that ends at (3, 3), and a third chart below the diagonal of square (0, 0).
  const auto value = [](const glm::vec3& p, std::size_t face) {
    const bool is_cut = face / 2 % 6 >= 3 && p.x == 3.0F && p.y < 3.0F;
    const glm::vec2 curved = glm::vec2(p) + glm::vec2(0, 0.1F * p.x * p.x + 0.2F * p.y * p.y);
    return curved + glm::vec2(is_cut ? 0.5F : 0.0F, face == 0 ? 9.0F : 0.0F);
  };
  const Texcoords before = texcoords(mesh, value);
  for (subdivide::SubdivideOptions options : every_rule(2)) {
    const Texcoords fine = charts(mesh, before, options);
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
      const glm::vec3 p = mesh.position(mesh.origin(Halfedge(h)));
      const bool is_pinned = p == glm::vec3(3, 3, 0) || p == glm::vec3(3, 0, 0) ||
                             p == glm::vec3(0, 0, 0) || p == glm::vec3(1, 1, 0) ||
                             p == glm::vec3(1, 0, 0) || p == glm::vec3(6, 0, 0);
      if (!is_pinned) continue;
      // The child of the corner, twice, has the corner at the same place.
      const std::size_t at = 3 * (4 * (4 * (h / 3) + h % 3) + h % 3) + h % 3;
      EXPECT_EQ(fine[at], before[h]) << p.x << ' ' << p.y;
    }
  }
}

TEST(Charts, ABadValueStaysInItsFace) {
  const Mesh mesh = sheet();
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Texcoords before =
        texcoords(mesh, [](const glm::vec3& p, std::size_t) { return glm::vec2(p); });
    before[3 * 40 + 1].x = bad;
    for (subdivide::SubdivideOptions options : every_rule(2)) {
      options.limit = true;
      const Texcoords fine = charts(mesh, before, options);
      for (std::size_t h = 0; h < fine.size(); ++h) {
        const bool is_finite = std::isfinite(fine[h].x) && std::isfinite(fine[h].y);
        EXPECT_TRUE(is_finite || h / 48 == 40) << h;
      }
      EXPECT_TRUE(std::isnan(fine[3 * (16 * 40 + 5) + 1].x));
    }
  }
}

TEST(Charts, SeveralThreadsGiveTheSameBytes) {
  const Mesh mesh = sheet();
  const Texcoords before = cut_sheet(mesh, {8, 0});
  for (const subdivide::SubdivideOptions& options : every_rule(4)) {
    Texcoords results[2];
    for (const unsigned threads : {1U, 2U}) {
      const ThreadLimit limit(threads);
      results[threads - 1] = charts(mesh, before, options);
    }
    EXPECT_TRUE(results[0] == results[1]);
  }
}

TEST(Charts, IntegersAreRoundedOnce) {
  const Mesh mesh = sheet();
  AttributeType type = texcoord_type();
  type.component = ComponentType::u16;
  type.is_normalized = true;
  Attributes attributes;
  attributes.layers.emplace_back(type, mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const glm::vec3 p = mesh.position(Vertex(v));
    store(attributes.layers[0], v, {p.x / 7.0, p.y / 7.0, 0, 0});
  }
  const subdivide::SubdivideOptions options{.levels = 3};
  const Mesh fine = subdivide::subdivide(mesh, options).mesh;
  const Attributes carried = subdivide::subdivide_attributes(mesh, attributes, fine, options);
  ASSERT_EQ(carried.layers.size(), 1U);
  EXPECT_TRUE(carried.layers[0].type() == type);
  EXPECT_FALSE(carried.has_seams());
  for (std::uint32_t v = 0; v < fine.vertex_count(); ++v) {
    const glm::vec3 p = fine.position(Vertex(v));
    if (p.x < 1.5F || p.y < 1.5F || p.x > 4.5F || p.y > 4.5F) continue;
    EXPECT_NEAR(load(carried.layers[0], v)[0], p.x / 7.0, 1.0 / 65535.0);
  }
}

TEST(Charts, ValuesOfOtherLayersStayLinear) {
  const Mesh mesh = sheet();
  CornerAttributes corners;
  corners.texcoord = cut_sheet(mesh, {8, 0});
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    corners.color.emplace_back(h % 251, 1, 2, 255);
  const Attributes attributes = to_wedges(mesh, std::move(corners));
  subdivide::SubdivideOptions options{.levels = 2};
  const Mesh fine = subdivide::subdivide(mesh, options).mesh;
  const Attributes smooth = subdivide::subdivide_attributes(mesh, attributes, fine, options);
  options.uv = subdivide::UvInterpolation::linear;
  const Attributes linear = subdivide::subdivide_attributes(mesh, attributes, fine, options);
  EXPECT_TRUE(validate(fine, smooth).empty());
  EXPECT_TRUE(to_corners(fine, smooth).color == to_corners(fine, linear).color);
  EXPECT_FALSE(to_corners(fine, smooth).texcoord == to_corners(fine, linear).texcoord);
  for (std::size_t i = 0; i < attributes.layers.size(); ++i)
    EXPECT_TRUE(smooth.layers[i].type() == attributes.layers[i].type());
}

}  // namespace
}  // namespace mesher::test
