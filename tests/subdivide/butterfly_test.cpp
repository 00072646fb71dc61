// Compares the interpolating schemes of the engine with OpenMesh and the oracles.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/mesh/build/build.h"
#include "engine/subdivide/subdivide.h"
#include "tests/subdivide/butterfly_oracle.h"
#include "tests/subdivide/compare.h"
#include "tests/subdivide/models.h"
#include "tests/subdivide/openmesh_reference.h"

namespace mesher::test {
namespace {

constexpr std::uint32_t kLevels = 3;

/// Models without creases; the papers have no rules for creases.
std::vector<const Model*> shapes() {
  std::vector<const Model*> result;
  for (const Model& model : models()) {
    if (is_untagged(model.mesh)) result.push_back(&model);
  }
  return result;
}

Mesh subdivided(const Mesh& mesh, subdivide::Scheme scheme, std::uint32_t levels) {
  return subdivide::subdivide(mesh, {.levels = levels, .scheme = scheme}).mesh;
}

TEST(Butterfly, AgreesWithOpenMeshOnEveryModelAndLevel) {
  ASSERT_GE(shapes().size(), 25U);
  for (const Model* model : shapes()) {
    SCOPED_TRACE(model->name);
    PlainMesh theirs = plain_mesh(model->mesh, subdivide::BoundaryRounding::edge_only);
    const double tolerance = kTolerance * diagonal(theirs.positions);
    const std::uint32_t levels = affordable_levels(model->mesh, kLevels);
    for (std::uint32_t level = 1; level <= levels; ++level) {
      SCOPED_TRACE("level " + std::to_string(level));
      theirs = openmesh_butterfly(theirs);
      expect_same(subdivided(model->mesh, subdivide::Scheme::butterfly, level), theirs, tolerance);
    }
  }
}

TEST(Butterfly, OracleAgreesWithOpenMesh) {
  for (const Model* model : shapes()) {
    SCOPED_TRACE(model->name);
    PlainMesh mesh = plain_mesh(model->mesh, subdivide::BoundaryRounding::edge_only);
    for (std::uint32_t level = 1; level <= 2; ++level) {
      const PlainMesh oracle = refine_butterfly(mesh);
      EXPECT_LT(largest_distance(oracle.positions, openmesh_butterfly(mesh).positions),
                1e-12 * diagonal(mesh.positions));
      mesh = oracle;
    }
  }
}

/// The faces on one side of a crease, with all vertices and the source of each face.
struct Side {
  Mesh mesh;
  std::vector<std::uint32_t> faces;
};

Side side_of(const Mesh& mesh, const std::vector<std::uint32_t>& faces) {
  Soup soup;
  soup.positions.assign(mesh.positions().begin(), mesh.positions().end());
  for (const std::uint32_t f : faces) {
    for (std::uint32_t k = 0; k < 3; ++k)
      soup.corners.push_back(mesh.origin(Mesh::halfedge(Face(f), k)).index());
  }
  return {build_mesh(std::move(soup), {.keep_isolated_vertices = true}).mesh, faces};
}

double largest_distance_of_corners(const Mesh& whole, const Side& side, const Mesh& fine,
                                   std::uint32_t levels) {
  const std::uint32_t children = 3U << (2 * levels);
  double worst = 0.0;
  for (std::uint32_t i = 0; i < side.faces.size(); ++i) {
    for (std::uint32_t k = 0; k < children; ++k) {
      const Vertex a = whole.origin(Halfedge(children * side.faces[i] + k));
      const Vertex b = fine.origin(Halfedge(children * i + k));
      worst = std::max(worst, double(glm::distance(whole.position(a), fine.position(b))));
    }
  }
  return worst;
}

TEST(Butterfly, CreaseLoopActsAsABoundary) {
  Mesh mesh = build_mesh(jittered(icosahedron(), 0.1F)).mesh;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const Edge e = mesh.find_edge(Vertex(1 + i), Vertex(1 + (i + 1) % 5));
    mesh.set_sharpness(e, kInfinitelySharp);
  }
  std::vector<std::uint32_t> cap;
  std::vector<std::uint32_t> rest;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const bool is_cap = mesh.origin(Mesh::halfedge(Face(f))) == Vertex(0);
    (is_cap ? cap : rest).push_back(f);
  }
  ASSERT_EQ(cap.size(), 5U);
  for (std::uint32_t levels = 1; levels <= kLevels; ++levels) {
    const Mesh whole = subdivided(mesh, subdivide::Scheme::butterfly, levels);
    for (const Side& side : {side_of(mesh, cap), side_of(mesh, rest)}) {
      const Mesh fine = subdivided(side.mesh, subdivide::Scheme::butterfly, levels);
      EXPECT_LE(largest_distance_of_corners(whole, side, fine, levels), 2 * kTolerance);
    }
  }
}

TEST(Midpoint, BisectsEdgesAndMovesNoVertex) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    const PlainMesh mesh = plain_mesh(model.mesh, subdivide::BoundaryRounding::edge_only);
    const Mesh fine = subdivided(model.mesh, subdivide::Scheme::midpoint, 2);
    expect_same(fine, refine_midpoint(refine_midpoint(mesh)),
                kTolerance * diagonal(mesh.positions));
  }
}

TEST(Interpolating, OldVerticesKeepTheirExactPosition) {
  for (const subdivide::Scheme scheme :
       {subdivide::Scheme::butterfly, subdivide::Scheme::midpoint}) {
    for (const bool limit : {false, true}) {
      for (const Model* model : shapes()) {
        SCOPED_TRACE(model->name);
        const Mesh fine =
            subdivide::subdivide(model->mesh, {.levels = 2, .scheme = scheme, .limit = limit}).mesh;
        ASSERT_GE(fine.vertex_count(), model->mesh.vertex_count());
        EXPECT_TRUE(std::equal(model->mesh.positions().begin(), model->mesh.positions().end(),
                               fine.positions().begin()));
      }
    }
  }
}

}  // namespace
}  // namespace mesher::test
