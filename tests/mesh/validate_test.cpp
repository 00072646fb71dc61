#include "engine/mesh/validate.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// Arrays of a valid mesh, for a test to break.
MeshArrays sound(Soup soup = cube()) {
  return MeshArrays::take(std::move(build_mesh(std::move(soup)).mesh));
}

void expect_broken(MeshArrays arrays, int invariant) {
  const auto violations = validate(std::move(arrays).finish());
  ASSERT_FALSE(violations.empty());
  bool is_named = false;
  for (const Violation& v : violations)
    is_named |= v.invariant == invariant;
  EXPECT_TRUE(is_named) << "found " << violations[0].invariant << ": " << violations[0].what;
}

TEST(Validate, AcceptsValidMeshes) {
  for (const Soup& soup : {cube(), grid(4), torus(6, 5), tetrahedron()})
    expect_valid(built(soup).mesh);
}

TEST(Validate, DetectsEachBrokenInvariant) {
  MeshArrays a = sound();
  a.twin.pop_back();
  expect_broken(std::move(a), 1);

  a = sound();
  a.origin[4] = Vertex(99);
  expect_broken(std::move(a), 2);
  a = sound();
  a.outgoing[2] = Halfedge(1000);
  expect_broken(std::move(a), 2);

  a = sound();
  a.twin[0] = Halfedge(0);
  expect_broken(std::move(a), 3);

  a = sound();
  std::swap(a.origin[0], a.origin[1]);
  expect_broken(std::move(a), 4);

  a = sound();
  a.origin[1] = a.origin[0];
  expect_broken(std::move(a), 5);

  // A triangle and its mirror image, joined along all edges.
  a = {};
  a.position.assign({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  a.origin.assign({Vertex(0), Vertex(1), Vertex(2), Vertex(0), Vertex(2), Vertex(1)});
  a.twin.assign({Halfedge(5), Halfedge(4), Halfedge(3), Halfedge(2), Halfedge(1), Halfedge(0)});
  a.outgoing.assign({Halfedge(0), Halfedge(1), Halfedge(2)});
  a.sharpness.assign(6, 0.0F);
  expect_broken(std::move(a), 6);

  a = sound();
  a.outgoing[3] = a.outgoing[4];
  expect_broken(std::move(a), 7);
  a = sound();
  a.outgoing[3] = Halfedge{};
  expect_broken(std::move(a), 7);

  // Two tetrahedra that share a vertex.
  a = sound(join(tetrahedron(), tetrahedron(), {3, 0, 0}));
  for (Vertex& v : a.origin)
    v = v == Vertex(4) ? Vertex(0) : v;
  a.outgoing[4] = Halfedge{};
  expect_broken(std::move(a), 8);

  // A boundary vertex whose ring starts in the middle.
  a = sound(grid(2));
  a.outgoing[1] = a.twin[Mesh::prev(a.outgoing[1]).index()];
  expect_broken(std::move(a), 9);

  // An edge cut open although all else is connected.
  a = sound();
  const Halfedge t = a.twin[0];
  a.twin[0] = a.twin[t.index()] = Halfedge{};
  expect_broken(std::move(a), 10);

  a = sound();
  a.sharpness[0] = 1.0F;
  expect_broken(std::move(a), 11);
  a = sound();
  a.sharpness[0] = -1.0F;
  expect_broken(std::move(a), 11);

  a = sound();
  a.position[0].x = std::nanf("");
  expect_broken(std::move(a), 12);
}

TEST(Validate, DetectsBrokenListsOfBowTieCopies) {
  const auto sound_copies = [] { return sound(bow_tie({cube(), cube(), cube()})); };
  expect_valid(sound_copies().finish());

  MeshArrays a = sound_copies();
  std::swap(a.bow_tie_copies[1], a.bow_tie_copies[2]);
  expect_broken(std::move(a), 13);
  a = sound_copies();
  a.bow_tie_copies[1].v = a.bow_tie_copies[0].v;
  expect_broken(std::move(a), 13);
  a = sound_copies();
  a.bow_tie_copies[2].v = Vertex(1000);
  expect_broken(std::move(a), 13);
  a = sound_copies();
  a.bow_tie_copies[2].first = a.bow_tie_copies[1].v;
  expect_broken(std::move(a), 13);
  a = sound_copies();
  a.bow_tie_copies.resize(1);
  expect_broken(std::move(a), 13);
  a = sound_copies();
  for (BowTieCopy& copy : a.bow_tie_copies)
    copy.first = Vertex(1000);
  expect_broken(std::move(a), 13);

  // A copy that no face uses.
  a = MeshArrays::take(
      std::move(build_mesh(soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, {0, 1, 2}),
                           {.keep_isolated_vertices = true})
                    .mesh));
  a.bow_tie_copies.assign({{Vertex(0), Vertex(0)}, {Vertex(3), Vertex(0)}});
  expect_broken(std::move(a), 13);

  a = sound_copies();
  a.position[a.bow_tie_copies[1].v.index()].x += 1.0F;
  expect_broken(std::move(a), 14);
}

TEST(Validate, StopsAtTheLimit) {
  MeshArrays a = sound(torus(20, 20));
  for (float& s : a.sharpness)
    s = -1.0F;
  EXPECT_EQ(validate(std::move(a).finish(), 7).size(), 7U);
}

}  // namespace
}  // namespace mesher::test
