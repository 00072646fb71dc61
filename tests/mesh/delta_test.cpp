#include "engine/mesh/delta.h"
#include "engine/core/memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <random>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mesh/collapse.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher {
namespace {

template <class T>
bool is_same(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

void expect_same_arrays(const Mesh& a, const Mesh& b) {
  EXPECT_TRUE(is_same(a.positions(), b.positions()));
  EXPECT_TRUE(is_same(a.origins(), b.origins()));
  EXPECT_TRUE(is_same(a.twins(), b.twins()));
  EXPECT_TRUE(is_same(a.outgoings(), b.outgoings()));
  EXPECT_TRUE(is_same(a.sharpnesses(), b.sharpnesses()));
  EXPECT_TRUE(is_same(a.vertex_sharpnesses(), b.vertex_sharpnesses()));
  EXPECT_TRUE(is_same(a.bow_tie_copies(), b.bow_tie_copies()));
}

bool is_noted(const Mesh& mesh, GpuArray array, std::uint32_t i) {
  if (mesh.changes().is_whole(array)) return true;
  for (const ChangedRange range : mesh.changes().merged(array)) {
    if (i >= range.begin && i < range.end) return true;
  }
  return false;
}

/// Expects that the log of `now` has every element that differs from `before`.
void expect_noted(const Mesh& now, const Mesh& before) {
  for (std::uint32_t v = 0; v < now.vertex_count(); ++v) {
    if (v < before.vertex_count() && now.position(Vertex(v)) == before.position(Vertex(v)))
      continue;
    EXPECT_TRUE(is_noted(now, GpuArray::position, v)) << v;
  }
  for (std::uint32_t i = 0; i < now.halfedge_count(); ++i) {
    const Halfedge h(i);
    const bool is_old = i < before.halfedge_count();
    if (!is_old || now.origin(h) != before.origin(h)) {
      EXPECT_TRUE(is_noted(now, GpuArray::origin, i)) << i;
    }
    if (!is_old || now.twin(h) != before.twin(h) || now.sharpness(h) != before.sharpness(h)) {
      EXPECT_TRUE(is_noted(now, GpuArray::edge_class, i)) << i;
    }
  }
}

void collapse_some(Mesh& mesh, int count, std::mt19937& random) {
  for (int tries = 0; count > 0 && tries < 1000; ++tries) {
    const Halfedge h(static_cast<std::uint32_t>(random() % mesh.halfedge_count()));
    if (!check_collapse(mesh, h).is_legal()) continue;
    collapse(mesh, h, 0.5F * (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h))));
    --count;
  }
}

Mesh creased_mesh() {
  Mesh mesh = build_mesh(test::join(test::grid(12), test::torus(12, 9), {0, 0, 9})).mesh;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); i += 11)
    mesh.set_sharpness(mesh.edge(Halfedge(i)), 2.0F);
  mesh.set_sharpness(Vertex(3), kInfinitelySharp);
  mesh.changes().clear();
  return mesh;
}

/// Applies the delta back and forth, and checks validity and the log each time.
void expect_round_trip(const Mesh& before, const Mesh& after) {
  const MeshDelta delta = difference(before, after);
  Mesh mesh = before;
  mesh.changes().clear();
  apply(mesh, delta);
  expect_same_arrays(mesh, after);
  expect_noted(mesh, before);
  test::expect_valid(mesh);
  mesh.changes().clear();
  revert(mesh, delta);
  expect_same_arrays(mesh, before);
  expect_noted(mesh, after);
  test::expect_valid(mesh);
}

TEST(MeshDelta, DifferenceOfEqualMeshesIsEmpty) {
  const Mesh mesh = creased_mesh();
  const MeshDelta nothing = difference(mesh, mesh);
  EXPECT_TRUE(nothing.is_empty());
  EXPECT_EQ(nothing.memory_bytes(), 0U);
  Mesh copy = mesh;
  apply(copy, nothing);
  EXPECT_TRUE(copy.changes().is_empty());
  EXPECT_TRUE(MeshDelta().is_empty());
}

TEST(MeshDelta, RoundTripsOverRandomCollapses) {
  std::mt19937 random(11);
  Mesh mesh = creased_mesh();
  for (const int count : {1, 1, 2, 5, 20, 60}) {
    const Mesh before = mesh;
    collapse_some(mesh, count, random);
    expect_round_trip(before, mesh);
  }
}

TEST(MeshDelta, RestoresBowTieCopies) {
  Mesh mesh = build_mesh(test::bow_tie({test::torus(12, 9), test::grid(6), test::cube()})).mesh;
  ASSERT_EQ(mesh.bow_tie_copies().size(), 3U);
  std::mt19937 random(13);
  std::size_t fewest = 3;
  for (int step = 0; step < 60; ++step) {
    const Mesh before = mesh;
    collapse_some(mesh, 1, random);
    expect_round_trip(before, mesh);
    fewest = std::min(fewest, mesh.bow_tie_copies().size());
  }
  EXPECT_EQ(fewest, 0U);
  MeshArrays arrays = MeshArrays::take(Mesh(mesh));
  arrays.bow_tie_copies.assign({{Vertex(0), Vertex(0)}, {Vertex(1), Vertex(0)}});
  const MeshDelta delta = difference(mesh, std::move(arrays).finish());
  EXPECT_FALSE(delta.is_empty());
  EXPECT_GT(delta.memory_bytes(), 0U);
}

TEST(MeshDelta, StackOfDeltasRestoresEveryState) {
  std::mt19937 random(12);
  Mesh mesh = creased_mesh();
  std::vector<Mesh> states{mesh};
  std::vector<MeshDelta> deltas;
  for (int i = 0; i < 15; ++i) {
    collapse_some(mesh, 1 + i, random);
    deltas.push_back(difference(states.back(), mesh));
    states.push_back(mesh);
  }
  for (std::size_t i = deltas.size(); i-- > 0;) {
    revert(mesh, deltas[i]);
    expect_same_arrays(mesh, states[i]);
  }
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    apply(mesh, deltas[i]);
    expect_same_arrays(mesh, states[i + 1]);
  }
}

TEST(MeshDelta, ReplacesAWholeMesh) {
  const Mesh small = build_mesh(test::cube()).mesh;
  const Mesh large = creased_mesh();
  expect_round_trip(small, large);
  expect_round_trip(large, small);
  expect_round_trip(Mesh(), large);
}

TEST(MeshDelta, ComparesPositionsBitwise) {
  Mesh mesh = build_mesh(test::cube()).mesh;
  mesh.set_position(Vertex(0), {0.0F, -0.5F, -0.5F});
  const Mesh before = mesh;
  mesh.set_position(Vertex(0), {-0.0F, -0.5F, -0.5F});
  EXPECT_FALSE(difference(before, mesh).is_empty());
  expect_round_trip(before, mesh);
}

TEST(MeshDelta, IsSmallForSmallChanges) {
  std::mt19937 random(13);
  Mesh mesh = build_mesh(test::torus(100, 100)).mesh;
  const Mesh before = mesh;
  collapse_some(mesh, 1, random);
  EXPECT_LT(difference(before, mesh).memory_bytes(), 2000U);
  EXPECT_GT(mesh.memory_bytes(), 800'000U);
}

TEST(MeshDelta, SameForAnyThreadCount) {
  std::mt19937 random(14);
  Mesh mesh = build_mesh(test::torus(400, test::kSanitized ? 100 : 300)).mesh;
  const Mesh before = mesh;
  collapse_some(mesh, 200, random);
  const std::size_t bytes = difference(before, mesh).memory_bytes();
  const ThreadLimit one(1);
  EXPECT_EQ(difference(before, mesh).memory_bytes(), bytes);
  expect_round_trip(before, mesh);
}

TEST(MeshDelta, LogsAVertexThatLosesItsFaces) {
  const Mesh with_face = build_mesh(test::soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}),
                                    {.keep_isolated_vertices = true})
                             .mesh;
  const Mesh without = build_mesh(test::soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}),
                                  {.keep_isolated_vertices = true})
                           .mesh;
  Mesh mesh = with_face;
  mesh.changes().clear();
  apply(mesh, difference(with_face, without));
  EXPECT_TRUE(is_noted(mesh, GpuArray::position, 1));
  expect_same_arrays(mesh, without);
}

TEST(MeshDelta, OutOfMemoryLeavesMeshUnchanged) {
  const Mesh small = creased_mesh();
  const Mesh large = build_mesh(test::torus(500, 400)).mesh;  // arrays of 2.4 and 4.8 MB
  const MeshDelta delta = difference(small, large);
  int failures = 0;
  for (std::uint64_t bytes = 0;; bytes += 1'000'000) {
    Mesh mesh = small;
    try {
      const MemoryLimit scarce(bytes);
      apply(mesh, delta);
    } catch (const std::bad_alloc&) {
      ++failures;
    }
    if (mesh.face_count() == large.face_count()) {
      expect_same_arrays(mesh, large);
      break;
    }
    expect_same_arrays(mesh, small);
    ASSERT_LT(failures, 100);
  }
  EXPECT_GT(failures, 5);
}

Attributes layers_of(std::size_t count, glm::vec2 texcoord, glm::u8vec4 color) {
  Attributes attributes;
  const Array<glm::vec2> texcoords(count, texcoord);
  const Array<glm::u8vec4> colors(count, color);
  attributes.layers.emplace_back(texcoord_type(), std::span(texcoords));
  attributes.layers.emplace_back(color_type(), std::span(colors));
  return attributes;
}

TEST(AttributesDelta, OutOfMemoryLeavesAttributesUnchanged) {
  const Attributes small = layers_of(30, {0.5F, 0.5F}, {1, 2, 3, 4});
  const Attributes large = layers_of(1'000'000, {0.25F, 0.5F}, {9, 9, 9, 9});
  for (const Attributes& before : {small, Attributes()}) {  // the same types, and others
    const AttributesDelta delta = difference(before, large);
    int failures = 0;
    for (std::uint64_t bytes = 0;; bytes += 1'000'000) {
      Attributes a = before;
      try {
        const MemoryLimit scarce(bytes);
        apply(a, delta);
      } catch (const std::bad_alloc&) {
        ++failures;
      }
      const bool is_done = !a.layers.empty() && a.layers[1].count() == large.layers[1].count();
      EXPECT_TRUE(difference(a, is_done ? large : before).is_empty());
      if (is_done) break;
      ASSERT_LT(failures, 100);
    }
    EXPECT_GT(failures, 3);
  }
}

TEST(AttributesDelta, RoundTrips) {
  Attributes before = layers_of(30, {0.5F, 0.5F}, {1, 2, 3, 4});
  before.group.assign(10, 1U);
  before.groups = test::named_groups({"a", "b"});
  Attributes other_values = before;
  other_values.layers[1].resize(27);
  other_values.layers[1].values<glm::u8vec4>()[5] = {9, 9, 9, 9};
  other_values.corner_wedge.assign(30, Wedge(3));
  other_values.further.assign(2, Vertex(1));
  Attributes other_types = other_values;
  other_types.layers.erase(other_types.layers.begin());
  other_types.group.resize(9);
  other_types.groups = test::named_groups({"a"});
  for (const Attributes& after : {other_values, other_types}) {
    const AttributesDelta delta = difference(before, after);
    EXPECT_FALSE(delta.is_empty());
    EXPECT_GT(delta.memory_bytes(), 30U);
    Attributes a = before;
    apply(a, delta);
    EXPECT_TRUE(difference(a, after).is_empty());
    EXPECT_EQ(a.groups, after.groups);
    revert(a, delta);
    EXPECT_TRUE(difference(a, before).is_empty());
    EXPECT_EQ(a.groups, before.groups);
  }
}

TEST(AttributesDelta, ValuesOfAnySizeAreCompared) {
  for (std::uint8_t components = 1; components <= 4; ++components) {
    Attributes before;
    before.layers.emplace_back(
        AttributeType{AttributeKind::joints, "JOINTS_0", components, ComponentType::u8}, 100);
    std::ranges::fill(before.layers[0].bytes(), std::byte{7});
    Attributes after = before;
    after.layers[0].value(41)[components - 1U] = std::byte{8};
    const AttributesDelta delta = difference(before, after);
    EXPECT_FALSE(delta.is_empty());
    Attributes a = before;
    apply(a, delta);
    EXPECT_TRUE(difference(a, after).is_empty());
    revert(a, delta);
    EXPECT_TRUE(difference(a, before).is_empty());
  }
}

}  // namespace
}  // namespace mesher
