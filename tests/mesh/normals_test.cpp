#include "engine/mesh/normals.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/mesh/circulators.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr float kRadiansPerDegree = 3.14159265F / 180.0F;

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-6F) {
  EXPECT_LE(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

TEST(Normals, FaceNormalFollowsTheRightHandRule) {
  const Mesh mesh = built(soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2})).mesh;
  expect_near(face_normal(mesh, Face(0)), {0, 0, 1});
}

TEST(Normals, TinyAndHugeMeshesHaveUnitNormals) {
  for (const float scale : {1e-12F, 1e-6F, 1.0F, 1e6F, 1e18F}) {
    Soup soup = torus(9, 7);
    for (glm::vec3& p : soup.positions)
      p *= scale;
    for (const NormalWeight w : {NormalWeight::uniform, NormalWeight::area, NormalWeight::angle}) {
      for (const glm::vec3& n : vertex_normals(built(Soup(soup)).mesh, w)) {
        EXPECT_NEAR(glm::length(n), 1.0F, 1e-5F);
      }
    }
  }
}

// At a corner of the cube, the diagonals give some sides two triangles. Only angle weights treat
// the three sides equally.
TEST(Normals, AngleWeightIgnoresTriangulation) {
  const Mesh mesh = built(cube()).mesh;
  for (std::uint32_t v = 0; v < 8; ++v) {
    expect_near(vertex_normal(mesh, Vertex(v), NormalWeight::angle),
                glm::normalize(mesh.position(Vertex(v))));
  }
  const glm::vec3 uniform = vertex_normal(mesh, Vertex(0), NormalWeight::uniform);
  EXPECT_GT(glm::length(uniform - glm::normalize(mesh.position(Vertex(0)))), 0.1F);
}

TEST(Normals, AreaWeightFavorsTheLargerFace) {
  // Two faces share an edge. The flat one has four times the area of the upright one.
  const Mesh mesh =
      built(soup_of({{0, 0, 0}, {0, 1, 0}, {-4, 0, 0}, {0, 0, -1}}, {0, 1, 2, 1, 0, 3})).mesh;
  const glm::vec3 n = vertex_normal(mesh, Vertex(0), NormalWeight::area);
  expect_near(n, glm::normalize(glm::vec3(1, 0, 4)));
}

TEST(Normals, DegenerateNeighborhoodGivesZeroAndNotNan) {
  const Mesh mesh = built(soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2})).mesh;
  EXPECT_EQ(vertex_normal(mesh, Vertex(0)), glm::vec3(0.0F));
  EXPECT_EQ(face_normal(mesh, Face(0)), glm::vec3(0.0F));
}

TEST(Normals, CornersOfACubeSplitByAngle) {
  const Mesh mesh = built(cube()).mesh;
  const auto split = corner_normals(mesh, {.crease_angle_rad = 60 * kRadiansPerDegree});
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    expect_near(split[h], face_normal(mesh, Mesh::face(Halfedge(h))));
  }
  const auto smooth = corner_normals(mesh, {.crease_angle_rad = 120 * kRadiansPerDegree});
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    expect_near(smooth[h], vertex_normal(mesh, mesh.origin(Halfedge(h))));
  }
}

TEST(Normals, CornersSplitAtCreasesOfAnyAngle) {
  Mesh mesh = built(cube()).mesh;
  for (std::uint32_t v = 0; v < 4; ++v) {  // around the side z = -1/2
    mesh.set_sharpness(mesh.find_edge(Vertex(v), Vertex((v + 1) % 4)), 1.0F);
  }
  const auto normals = corner_normals(mesh, {});
  for (const Halfedge h : halfedges_around(mesh, Vertex(0))) {
    const glm::vec3 face = face_normal(mesh, Mesh::face(h));
    if (face.z < -0.5F) {
      expect_near(normals[h.index()], {0, 0, -1});
    } else {
      expect_near(normals[h.index()], glm::normalize(glm::vec3(-1, -1, 0)));
    }
  }
  const auto unsplit = corner_normals(mesh, {.split_at_creases = false});
  expect_near(unsplit[mesh.outgoing(Vertex(0)).index()], glm::normalize(mesh.position(Vertex(0))));
}

// A dart, one sharp edge that ends inside a surface, separates no corners.
TEST(Normals, DartDoesNotSplitCorners) {
  Mesh mesh = built(torus(9, 7)).mesh;
  const Vertex v(10);
  const Halfedge h = mesh.outgoing(v);
  mesh.set_sharpness(mesh.edge(h), kInfinitelySharp);
  const auto normals = corner_normals(mesh, {});
  for (const Halfedge o : halfedges_around(mesh, v)) {
    expect_near(normals[o.index()], vertex_normal(mesh, v));
  }
}

TEST(Normals, UpdatingOneRingEqualsRecomputingAll) {
  Mesh mesh = built(torus(9, 7)).mesh;
  const CornerNormalOptions options{.crease_angle_rad = 30 * kRadiansPerDegree};
  auto normals = corner_normals(mesh, options);
  const Vertex v(20);
  mesh.set_position(v, mesh.position(v) * 1.3F);
  update_corner_normals(mesh, v, options, normals);
  for (const Vertex n : vertices_around(mesh, v))
    update_corner_normals(mesh, n, options, normals);
  const auto fresh = corner_normals(mesh, options);
  for (std::size_t h = 0; h < fresh.size(); ++h)
    expect_near(normals[h], fresh[h], 0.0F);
}

TEST(Normals, BoundaryFanIsOneRun) {
  const Mesh mesh = built(grid(3)).mesh;
  for (const glm::vec3& n : corner_normals(mesh, {}))
    expect_near(n, {0, 0, 1});
}

}  // namespace
}  // namespace mesher::test
