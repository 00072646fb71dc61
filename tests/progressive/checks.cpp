#include "tests/progressive/checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <algorithm>

#include "engine/mesh/circulators.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

void expect_lowest_outgoing(const Mesh& mesh) {
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vertex v(i);
    if (mesh.is_isolated(v) || mesh.is_boundary(v)) continue;
    for (const Halfedge h : halfedges_around(mesh, v))
      ASSERT_LE(mesh.outgoing(v), h) << "P3 at vertex " << i;
  }
}

/// Checks P4 as documented: which corners of this level are at the parent now and at the child
/// afterward.
void expect_moved(const progressive::ProgressiveMesh& mesh) {
  const std::uint32_t split = mesh.level();
  for (const Halfedge h : mesh.moved(split)) {
    ASSERT_LT(h.index(), mesh.mesh().halfedge_count());
    ASSERT_EQ(mesh.mesh().origin(h), mesh.splits()[split].parent);
  }
}

}  // namespace

Mesh without_copies(const Mesh& mesh) {
  MeshArrays arrays = MeshArrays::take(Mesh(mesh));
  arrays.bow_tie_copies.clear();
  return std::move(arrays).finish();
}

void expect_valid_level(const progressive::ProgressiveMesh& mesh) {
  expect_valid(mesh.mesh());
  EXPECT_EQ(mesh.mesh().vertex_count(), mesh.base_vertex_count() + mesh.level());
  EXPECT_EQ(mesh.mesh().face_count(), mesh.face_count(mesh.level()));
  expect_lowest_outgoing(mesh.mesh());
  if (mesh.level() < mesh.split_count()) expect_moved(mesh);
}

std::vector<Mesh> levels(progressive::ProgressiveMesh& mesh, const std::vector<std::uint32_t>& at) {
  std::vector<Mesh> found;
  for (const std::uint32_t level : at) {
    mesh.go_to(level);
    found.push_back(mesh.mesh());
  }
  return found;
}

std::vector<std::uint32_t> some_levels(const progressive::ProgressiveMesh& mesh,
                                       std::uint32_t count) {
  std::vector<std::uint32_t> at;
  const std::uint64_t splits = mesh.split_count();
  for (std::uint64_t i = 0; i <= count; ++i)
    at.push_back(static_cast<std::uint32_t>(splits * i / count));
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

progressive::ProgressiveMesh appended(progressive::ProgressiveMesh& mesh) {
  mesh.go_to(0);
  progressive::ProgressiveMesh copy{Mesh(mesh.mesh())};
  for (std::uint32_t i = 0; i < mesh.split_count(); ++i) {
    mesh.go_to(i);
    const progressive::NewSplit split = mesh.next_split();
    if (!copy.can_append(split.parent, split.cut)) {
      ADD_FAILURE() << "split " << i << " cannot be appended";
      break;
    }
    copy.append(split);
  }
  return copy;
}

void expect_same(progressive::ProgressiveMesh& a, progressive::ProgressiveMesh& b) {
  ASSERT_EQ(a.split_count(), b.split_count());
  EXPECT_EQ(a.base_vertex_count(), b.base_vertex_count());
  EXPECT_EQ(a.base_face_count(), b.base_face_count());
  EXPECT_EQ(a.full_face_count(), b.full_face_count());
  EXPECT_TRUE(is_equal(a.splits(), b.splits()));
  EXPECT_TRUE(is_equal(a.sharpnesses(), b.sharpnesses()));
  EXPECT_TRUE(is_equal(a.corner_sharpnesses(), b.corner_sharpnesses()));
  for (std::uint32_t i = 0; i < a.split_count(); ++i)
    ASSERT_TRUE(is_equal(a.moved(i), b.moved(i))) << "split " << i;
  for (const std::uint32_t level : {0U, a.split_count()}) {
    a.go_to(level);
    b.go_to(level);
    EXPECT_TRUE(is_identical(without_copies(a.mesh()), without_copies(b.mesh())))
        << "level " << level;
  }
}

void examine_levels(progressive::ProgressiveMesh& mesh, std::uint32_t count) {
  std::vector<std::uint32_t> at = some_levels(mesh, count);
  mesh.go_to(0);
  const std::vector<Mesh> up = levels(mesh, at);
  for (std::size_t i = at.size(); i-- > 0;) {
    mesh.go_to(at[i]);
    EXPECT_TRUE(is_identical(mesh.mesh(), up[i])) << "down to level " << at[i];
    expect_valid_level(mesh);
    if (testing::Test::HasFailure()) return;
  }
  // Jump back and forth over the longest distances.
  for (std::size_t i = 0; i < at.size(); ++i) {
    const std::size_t k = i % 2 == 0 ? i : at.size() - i;
    mesh.go_to(at[k]);
    EXPECT_TRUE(is_identical(mesh.mesh(), up[k])) << "jump to level " << at[k];
  }
}

void expect_valid_level(const progressive::ProgressiveMesh& pm,
                        const progressive::ProgressiveAttributes& all) {
  const Mesh& mesh = pm.mesh();
  std::vector<Vertex> vertex(all.wedge_count(all.level()));
  for (std::uint32_t h = 0; !all.has_no_layers() && h < mesh.halfedge_count(); ++h) {
    const Wedge w = all.corner_wedges()[h];
    ASSERT_LT(w.index(), vertex.size());
    Vertex& its = vertex[w.index()];
    if (!its.is_valid()) its = mesh.origin(Halfedge(h));
    ASSERT_EQ(its, mesh.origin(Halfedge(h)));
  }
  ASSERT_TRUE(std::ranges::all_of(vertex, [](Vertex v) { return v.is_valid(); }));
  if (all.level() < all.split_count()) {
    std::set<Halfedge> corners;
    for (const progressive::CornerChange& change : all.corner_changes(all.level())) {
      ASSERT_LT(change.corner.index(), mesh.halfedge_count());
      ASSERT_TRUE(corners.insert(change.corner).second);
    }
    std::set<Wedge> wedges;
    for (const Wedge w : all.changed_wedges(all.level())) {
      ASSERT_LT(w.index(), vertex.size());
      ASSERT_TRUE(wedges.insert(w).second);
    }
  }
  const Attributes attributes = all.at_level(mesh);
  for (const Violation& violation : validate(mesh, attributes))
    ADD_FAILURE() << "invariant " << violation.invariant << ": " << violation.what;
}

}  // namespace mesher::test
