// Compares normals of the limit surface with the oracle and with the faces that converge to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/subdivide/subdivide.h"
#include "tests/subdivide/compare.h"
#include "tests/subdivide/derose98_oracle.h"
#include "tests/subdivide/hoppe94_oracle.h"
#include "tests/subdivide/models.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

constexpr subdivide::CreaseRules kFamilies[] = {subdivide::CreaseRules::hoppe94,
                                                subdivide::CreaseRules::derose98};

double angle_deg(const Point& a, const Point& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

subdivide::Subdivided at_the_limit(const Mesh& mesh, subdivide::CreaseRules creases,
                                   subdivide::CreaseDecay decay, std::uint32_t levels) {
  return subdivide::subdivide(
      mesh, {.levels = levels, .creases = creases, .decay = decay, .limit = true});
}

TEST(LimitNormals, AreUnitLengthAndOnePerCorner) {
  for (const subdivide::CreaseRules creases : kFamilies) {
    for (const Model& model : models()) {
      if (model.mesh.face_count() > 200) continue;
      SCOPED_TRACE(model.name);
      for (std::uint32_t levels = 0; levels <= 2; ++levels) {
        const subdivide::Subdivided ours =
            at_the_limit(model.mesh, creases, subdivide::CreaseDecay::uniform, levels);
        ASSERT_EQ(ours.limit_normal.size(), ours.mesh.halfedge_count());
        for (const glm::vec3& n : ours.limit_normal)
          ASSERT_NEAR(glm::length(n), 1.0F, 1e-5F);
      }
    }
  }
}

TEST(LimitNormals, AreComputedOnlyAtTheLimit) {
  const Mesh& mesh = models().front().mesh;
  EXPECT_TRUE(subdivide::subdivide(mesh, {.levels = 1}).limit_normal.empty());
  for (const subdivide::Scheme scheme :
       {subdivide::Scheme::butterfly, subdivide::Scheme::midpoint}) {
    EXPECT_TRUE(subdivide::subdivide(mesh, {.levels = 1, .scheme = scheme, .limit = true})
                    .limit_normal.empty());
  }
}

/// Largest angle to the normals of the oracle, where it has any.
double worst_angle_deg(const subdivide::Subdivided& ours, const std::vector<Point>& oracle) {
  double worst = 0.0;
  for (std::size_t c = 0; c < oracle.size(); ++c) {
    if (oracle[c] == Point(0.0)) continue;
    worst = std::max(worst, angle_deg(Point(ours.limit_normal[c]), oracle[c]));
  }
  return worst;
}

TEST(LimitNormals, AgreeWithConvergedFaceNormals) {
  for (const subdivide::CreaseRules creases : kFamilies) {
    for (const subdivide::CreaseDecay decay : kDecays) {
      const OracleRules rules =
          creases == subdivide::CreaseRules::hoppe94 ? hoppe94_rules(decay) : derose98_rules(decay);
      for (const Model& model : models()) {
        if (decay != subdivide::CreaseDecay::uniform && is_settled(model.mesh)) continue;
        if (model.mesh.face_count() > 60) continue;
        PlainMesh plain = plain_mesh(model.mesh, subdivide::BoundaryRounding::edge_only);
        for (std::uint32_t level = 0; level <= (kSanitized ? 0 : 1); ++level) {
          if (level > 0) plain = refine(plain, rules);
          const subdivide::Subdivided ours = at_the_limit(model.mesh, creases, decay, level);
          ASSERT_EQ(ours.limit_normal.size(), 3 * plain.triangles.size());
          EXPECT_LT(worst_angle_deg(ours, limit_normals(plain, rules)), 0.5)
              << model.name << ", creases " << int(creases) << ", decay " << int(decay)
              << ", level " << level;
        }
      }
    }
  }
}

/// Mean angle between the limit normals and the area-weighted normals of old vertices `deeper`
/// levels below.
double mean_angle_deg(const Mesh& mesh, std::uint32_t deeper) {
  const subdivide::Subdivided limit =
      at_the_limit(mesh, subdivide::CreaseRules::hoppe94, subdivide::CreaseDecay::uniform, 0);
  if (limit.limit_normal.size() != mesh.halfedge_count()) return kForEver;
  const Mesh fine = subdivide::subdivide(mesh, {.levels = deeper}).mesh;
  std::vector<Point> sum(mesh.vertex_count(), Point(0.0));
  for (std::uint32_t f = 0; f < fine.face_count(); ++f) {
    const auto corner = [&](std::uint32_t k) { return fine.origin(Mesh::halfedge(Face(f), k)); };
    const auto at = [&](std::uint32_t k) { return Point(fine.position(corner(k))); };
    const Point normal = glm::cross(at(1) - at(0), at(2) - at(0));
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (corner(k).index() < sum.size()) sum[corner(k).index()] += normal;
    }
  }
  double total = 0.0;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    total += angle_deg(Point(limit.limit_normal[h]), sum[mesh.origin(Halfedge(h)).index()]);
  return total / mesh.halfedge_count();
}

TEST(LimitNormals, FaceNormalsOfSmoothModelsConverge) {
  std::size_t compared = 0;
  for (const Model& model : models()) {
    if (!is_untagged(model.mesh) || has_boundary(model.mesh)) continue;
    if (affordable_levels(model.mesh, 5) < 4) continue;
    SCOPED_TRACE(model.name);
    const double coarse = mean_angle_deg(model.mesh, 2);
    const double fine = mean_angle_deg(model.mesh, 4);
    EXPECT_LT(fine, 2.0);
    EXPECT_TRUE(fine < 0.6 * coarse || fine < 0.05) << coarse << ' ' << fine;
    ++compared;
  }
  EXPECT_GE(compared, 10U);
}

}  // namespace
}  // namespace mesher::test
