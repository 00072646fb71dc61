#include "engine/progressive/progressive_mesh.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "engine/mesh/circulators.h"
#include "tests/progressive/checks.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// Refines a base by splits of random parents with random cuts.
class RandomSplits {
 public:
  explicit RandomSplits(std::uint32_t seed) : random_(seed) {}

  void append(progressive::ProgressiveMesh& mesh, bool is_sharp) {
    for (;;) {
      const Vertex parent(number(mesh.mesh().vertex_count()));
      progressive::SplitCut cut{.left = number(12), .right = number(12)};
      if (number(4) == 0) cut.right = kNone;
      if (!mesh.can_append(parent, cut)) continue;
      progressive::NewSplit split{
          .parent = parent, .cut = cut, .parent_position = place(), .child_position = place()};
      if (is_sharp) sharpen(mesh.mesh(), parent, split);
      mesh.append(split);
      return;
    }
  }

 private:
  std::uint32_t number(std::uint32_t below) {
    return static_cast<std::uint32_t>(random_() % below);
  }
  glm::vec3 place() {
    const auto coordinate = [&] { return static_cast<float>(number(1000)) * 0.01F; };
    return {coordinate(), coordinate(), coordinate()};
  }

  /// One of the two sides of each new face keeps the sharpness of the split edge.
  void sharpen(const Mesh& mesh, Vertex parent, progressive::NewSplit& split) {
    std::vector<Halfedge> spokes;
    for (const Halfedge h : halfedges_around(mesh, parent))
      spokes.push_back(h);
    const auto sharpness_at = [&](std::uint32_t slot) {
      if (slot == kNone) return 0.0F;
      return slot < spokes.size() ? mesh.sharpness(spokes[slot])
                                  : mesh.sharpness(Mesh::prev(spokes.back()));
    };
    split.sharpness.edge = number(3) == 0 ? 1.5F : 0.0F;
    split.sharpness.sides = {sharpness_at(split.cut.left), 0.0F, 0.0F,
                             sharpness_at(split.cut.right)};
    if (number(2) == 0) std::swap(split.sharpness.sides[0], split.sharpness.sides[1]);
    split.parent_corner_sharpness = mesh.sharpness(parent);
  }

  std::mt19937 random_;
};

std::vector<Mesh> bases() {
  std::vector<Mesh> all;
  for (Soup soup : {tetrahedron(), cube(), grid(1), grid(3), torus(5, 4),
                    join(torus(4, 3), grid(2), {9, 0, 0})}) {
    all.push_back(built(std::move(soup)).mesh);
  }
  return all;
}

TEST(ProgressiveMesh, EveryAppendableSplitKeepsTheMeshValid) {
  std::uint32_t seed = 0;
  for (Mesh& base : bases()) {
    SCOPED_TRACE(base.face_count());
    const Topology before = topology(base);
    progressive::ProgressiveMesh mesh(std::move(base));
    RandomSplits splits(++seed);
    for (int i = 0; i < 150; ++i) {
      splits.append(mesh, false);
      expect_valid_level(mesh);
      ASSERT_FALSE(HasFailure()) << "split " << i;
    }
    EXPECT_EQ(topology(mesh.mesh()), before);
    examine_levels(mesh, 60);
  }
}

TEST(ProgressiveMesh, SharpnessFollowsTheSplits) {
  std::uint32_t seed = 100;
  for (Mesh& base : bases()) {
    base.set_sharpness(base.edge(Halfedge(0)), 2.5F);
    base.set_sharpness(base.edge(Halfedge(4)), kInfinitelySharp);
    base.set_sharpness(Vertex(1), 3.0F);
    progressive::ProgressiveMesh mesh(std::move(base));
    RandomSplits splits(++seed);
    for (int i = 0; i < 80; ++i)
      splits.append(mesh, true);
    EXPECT_EQ(mesh.sharpnesses().size(), mesh.split_count());
    EXPECT_EQ(mesh.corner_sharpnesses().size(), mesh.split_count());
    examine_levels(mesh, 80);
    progressive::ProgressiveMesh again = appended(mesh);
    expect_same(mesh, again);
  }
}

TEST(ProgressiveMesh, NextSplitReturnsTheAppendedSplit) {
  progressive::ProgressiveMesh mesh(built(grid(3)).mesh);
  RandomSplits splits(7);
  for (int i = 0; i < 100; ++i)
    splits.append(mesh, false);
  progressive::ProgressiveMesh again = appended(mesh);
  expect_same(mesh, again);
}

/// A mirror that copies only the logged changes.
class Mirror {
 public:
  explicit Mirror(Mesh& mesh) {
    mesh.changes().note_all();
    follow(mesh);
  }
  void follow(Mesh& mesh) {
    copy(mesh, GpuArray::position, mesh.positions(), position_);
    copy(mesh, GpuArray::origin, mesh.origins(), origin_);
    Array<EdgeClass> classes;
    for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
      classes.push_back(mesh.edge_class(Halfedge(h)));
    copy(mesh, GpuArray::edge_class, std::span<const EdgeClass>(classes), class_);
    EXPECT_TRUE(is_equal(std::span<const glm::vec3>(position_), mesh.positions()));
    EXPECT_TRUE(is_equal(std::span<const Vertex>(origin_), mesh.origins()));
    EXPECT_TRUE(class_ == classes);
    mesh.changes().clear();
  }

 private:
  template <class T>
  void copy(const Mesh& mesh, GpuArray array, std::span<const T> from, Array<T>& to) {
    to.resize(from.size());
    if (mesh.changes().is_whole(array)) {
      std::copy(from.begin(), from.end(), to.begin());
      return;
    }
    for (const ChangedRange range :
         mesh.changes().merged(array, 0, static_cast<std::uint32_t>(from.size()))) {
      std::copy(from.begin() + range.begin, from.begin() + range.end, to.begin() + range.begin);
    }
  }

  Array<glm::vec3> position_;
  Array<Vertex> origin_;
  Array<EdgeClass> class_;
};

TEST(ProgressiveMesh, LogsEveryChange) {
  for (Mesh& base : bases()) {
    progressive::ProgressiveMesh mesh(std::move(base));
    RandomSplits splits(3);
    for (int i = 0; i < 120; ++i)
      splits.append(mesh, false);
    Mirror mirror(mesh.mesh());
    std::mt19937 random(4);
    for (int i = 0; i < 40; ++i) {
      mesh.go_to(static_cast<std::uint32_t>(random() % (mesh.split_count() + 1)));
      mirror.follow(mesh.mesh());
      ASSERT_FALSE(HasFailure());
    }
  }
}

TEST(ProgressiveMesh, StepLogsOnlyItsNeighborhood) {
  progressive::ProgressiveMesh mesh(built(torus(40, 30)).mesh);
  RandomSplits splits(9);
  for (int i = 0; i < 50; ++i)
    splits.append(mesh, false);
  mesh.mesh().changes().clear();
  mesh.go_to(mesh.split_count() - 1);
  std::uint32_t corners = 0;
  for (const ChangedRange range : mesh.mesh().changes().merged(GpuArray::origin))
    corners += range.end - range.begin;
  EXPECT_GT(corners, 0U);
  EXPECT_LE(corners, 6 + mesh.moved(mesh.split_count() - 1).size());
}

TEST(ProgressiveMesh, LevelForFacesIsTheFinestWithinTheCount) {
  progressive::ProgressiveMesh mesh(built(grid(3)).mesh);
  RandomSplits splits(11);
  for (int i = 0; i < 60; ++i)
    splits.append(mesh, false);
  for (std::uint32_t faces = 0; faces < mesh.full_face_count() + 3; ++faces) {
    const std::uint32_t level = mesh.level_for_faces(faces);
    if (level > 0) {
      EXPECT_LE(mesh.face_count(level), faces);
    }
    if (level < mesh.split_count()) {
      EXPECT_GT(mesh.face_count(level + 1), faces);
    }
  }
}

TEST(ProgressiveMesh, RejectsInvalidCuts) {
  Soup soup = grid(1);
  soup.positions.emplace_back(9.0F, 9.0F, 9.0F);
  const progressive::ProgressiveMesh open(
      built(std::move(soup), {.keep_isolated_vertices = true}).mesh);
  const Vertex isolated(4);
  ASSERT_TRUE(open.mesh().is_isolated(isolated));
  EXPECT_FALSE(open.can_append(isolated, {0, 1}));
  EXPECT_FALSE(open.can_append(Vertex(5), {0, 1}));
  EXPECT_FALSE(open.can_append(Vertex{}, {0, 1}));
  const Vertex v = open.mesh().origin(Halfedge(0));
  const std::uint32_t faces = open.mesh().valence(v) - 1;
  EXPECT_TRUE(open.can_append(v, {0, faces}));
  EXPECT_TRUE(open.can_append(v, {faces, 0}));
  EXPECT_TRUE(open.can_append(v, {faces, kNone}));
  EXPECT_FALSE(open.can_append(v, {faces + 1, kNone}));
  EXPECT_FALSE(open.can_append(v, {0, faces + 1}));
  EXPECT_FALSE(open.can_append(v, {1, 1}));
  const progressive::ProgressiveMesh closed(built(tetrahedron()).mesh);
  EXPECT_TRUE(closed.can_append(Vertex(0), {2, 0}));
  EXPECT_FALSE(closed.can_append(Vertex(0), {3, 0}));
  EXPECT_FALSE(closed.can_append(Vertex(0), {0, kNone}))
      << "a cut inside the surface must not open";
}

TEST(ProgressiveMesh, EmptyMeshHasOneLevel) {
  progressive::ProgressiveMesh mesh{Mesh()};
  mesh.go_to(0);
  EXPECT_EQ(mesh.split_count(), 0U);
  EXPECT_EQ(mesh.level_for_faces(100), 0U);
  EXPECT_FALSE(mesh.can_append(Vertex(0), {0, 1}));
}

}  // namespace
}  // namespace mesher::test
