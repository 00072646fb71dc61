#include "tests/subdivide/compare.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

bool is_near(double a, double b) {
  return a == b || std::abs(a - b) < 1e-4;
}

}  // namespace

std::vector<subdivide::SubdivideOptions> every_rule(std::uint32_t levels) {
  std::vector<subdivide::SubdivideOptions> all{
      {.levels = levels, .scheme = subdivide::Scheme::butterfly},
      {.levels = levels, .scheme = subdivide::Scheme::midpoint}};
  for (const subdivide::CreaseRules creases :
       {subdivide::CreaseRules::hoppe94, subdivide::CreaseRules::derose98}) {
    for (const subdivide::BoundaryRounding boundary : kBoundaries) {
      for (const subdivide::CreaseDecay decay : kDecays) {
        for (const bool limit : {false, true}) {
          all.push_back({.levels = levels,
                         .creases = creases,
                         .boundary = boundary,
                         .decay = decay,
                         .limit = limit});
        }
      }
    }
  }
  return all;
}

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> triangles(mesh.face_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    triangles[h / 3][h % 3] = mesh.origin(Halfedge(h)).index();
  return triangles;
}

void expect_same(const Mesh& ours, const PlainMesh& reference, double tolerance) {
  expect_valid(ours);
  ASSERT_EQ(ours.vertex_count(), reference.positions.size());
  // EXPECT_EQ would print both lists.
  EXPECT_TRUE(triangles_of(ours) == reference.triangles);
  EXPECT_LE(largest_distance(points_of(ours.positions()), reference.positions), tolerance);
}

void expect_same_sharpness(const Mesh& ours, const PlainMesh& reference) {
  ASSERT_EQ(ours.vertex_count(), reference.positions.size());
  std::vector<int> faces_at(ours.vertex_count());
  std::size_t different = 0;
  for (std::uint32_t i = 0; i < ours.halfedge_count(); ++i) {
    const Halfedge h(i);
    ++faces_at[ours.origin(h).index()];
    if (ours.is_boundary(h)) continue;
    const double theirs = sharpness_of(reference, ours.origin(h).index(), ours.target(h).index());
    if (!is_near(settled(ours.sharpness(h)), theirs)) ++different;
  }
  EXPECT_EQ(different, 0U) << "half-edges with a different sharpness";
  for (std::uint32_t v = 0; v < ours.vertex_count(); ++v) {
    // Sharp by rule, or isolated.
    if (faces_at[v] < 2 || ours.is_bow_tie_copy(Vertex(v))) continue;
    EXPECT_TRUE(is_near(settled(ours.sharpness(Vertex(v))), reference.vertex_sharpness[v]))
        << "vertex " << v;
  }
}

bool has_boundary(const Mesh& mesh) {
  return std::any_of(mesh.twins().begin(), mesh.twins().end(),
                     [](Halfedge h) { return !h.is_valid(); });
}

}  // namespace mesher::test
