#include "engine/render/gpu_mesh.h"

#include <array>
#include <random>
#include <set>

#include "engine/io/read.h"
#include "engine/mesh/collapse.h"
#include "engine/mesh/delta.h"
#include "tests/render/looks.h"
#include "tests/support/gpu_test.h"
#include "tests/support/meshes.h"

namespace mesher::render {
namespace {

using GpuMeshTest = test::GpuTest;

const Settings kSplit{.shading = Shading::gouraud, .crease_angle_deg = 30.0F};

/// The content of a fresh mirror of the same arrays.
std::vector<std::byte> fresh_content(gpu::Device& device, const Mesh& mesh,
                                     const Settings& settings) {
  Mesh copy = mesh;
  GpuMesh mirror(device);
  mirror.apply(copy, settings);
  return mirror.read_back();
}

/// Collapses a random legal edge if a few tries find one.
void collapse_any(Mesh& mesh, std::mt19937& random) {
  for (int tries = 0; tries < 50; ++tries) {
    const Halfedge h(static_cast<std::uint32_t>(random() % mesh.halfedge_count()));
    if (!check_collapse(mesh, h).is_legal()) continue;
    collapse(mesh, h, 0.5F * (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h))));
    return;
  }
}

void edit(Mesh& mesh, std::mt19937& random) {
  std::uniform_real_distribution<float> jitter(-0.2F, 0.2F);
  const Vertex v(static_cast<std::uint32_t>(random() % mesh.vertex_count()));
  const Halfedge h(static_cast<std::uint32_t>(random() % mesh.halfedge_count()));
  switch (random() % 4) {
    case 0:
    case 1:
      mesh.set_position(
          v, mesh.position(v) + glm::vec3(jitter(random), jitter(random), jitter(random)));
      break;
    case 2:
      collapse_any(mesh, random);
      break;
    default:
      constexpr std::array kSharpness{0.0F, 0.5F, 1.0F, 7.25F, kInfinitelySharp};
      mesh.set_sharpness(mesh.edge(h), kSharpness[random() % kSharpness.size()]);
  }
}

TEST_F(GpuMeshTest, MirrorsTheArraysByteForByte) {
  Mesh mesh = build_mesh(test::grid(5)).mesh;
  GpuMesh mirror(device());
  const UploadStats stats = mirror.apply(mesh, kFlat);
  EXPECT_EQ(stats.uploaded_bytes, stats.total_bytes);
  EXPECT_TRUE(mesh.changes().is_empty());
  const auto positions = std::as_bytes(mesh.positions());
  const auto indices = std::as_bytes(mesh.origins());
  const std::vector<std::byte> content = mirror.read_back();
  ASSERT_GE(content.size(), positions.size() + indices.size());
  EXPECT_TRUE(std::equal(positions.begin(), positions.end(), content.begin()));
  EXPECT_TRUE(std::equal(indices.begin(), indices.end(), content.begin() + positions.size()));
  EXPECT_EQ(mirror.boundary_count(), 20U);
  EXPECT_EQ(mirror.crease_count(), 0U);
}

TEST_F(GpuMeshTest, PacksEdgeClassesInTwoBitsPerHalfedge) {
  Mesh mesh = build_mesh(test::grid(5)).mesh;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); i += 7) {
    mesh.set_sharpness(mesh.edge(Halfedge(i)), kInfinitelySharp);
  }
  GpuMesh mirror(device());
  mirror.apply(mesh, kFlat);
  const std::vector<std::byte> bytes =
      gpu::download(device(), mirror.classes(), mirror.classes().size());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const auto packed = std::to_integer<unsigned>(bytes[h / 4]) >> 2 * (h % 4) & 3U;
    EXPECT_EQ(packed, static_cast<unsigned>(mesh.edge_class(Halfedge(h)))) << h;
  }
}

TEST_F(GpuMeshTest, AnyEditsEqualAFreshMirror) {
  for (const Settings& settings : {kFlat, kGouraud, kSplit}) {
    Mesh mesh = build_mesh(test::join(test::grid(12), test::torus(10, 8), {0, 0, 9})).mesh;
    GpuMesh mirror(device());
    mirror.apply(mesh, settings);
    std::mt19937 random(7);
    for (int round = 0; round < 12; ++round) {
      for (int i = 0; i < 1 + round % 5; ++i)
        edit(mesh, random);
      mirror.apply(mesh, settings);
      EXPECT_TRUE(mesh.changes().is_empty());
      ASSERT_EQ(mirror.read_back(), fresh_content(device(), mesh, settings)) << "round " << round;
    }
  }
}

TEST_F(GpuMeshTest, ShrinkingAndGrowingEqualAFreshMirror) {
  for (const Settings& settings : {kFlat, kGouraud, kSplit}) {
    Mesh mesh = build_mesh(test::join(test::grid(12), test::torus(10, 8), {0, 0, 9})).mesh;
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); i += 97)
      mesh.set_sharpness(mesh.edge(Halfedge(i)), 1.0F);
    GpuMesh mirror(device());
    mirror.apply(mesh, settings);
    std::mt19937 random(8);
    std::vector<MeshDelta> deltas;
    const auto expect_mirrored = [&] {
      const UploadStats stats = mirror.apply(mesh, settings);
      EXPECT_EQ(mirror.face_count(), mesh.face_count());
      EXPECT_EQ(mirror.vertex_count(), mesh.vertex_count());
      EXPECT_LE(stats.uploaded_bytes, stats.total_bytes);
      ASSERT_TRUE(mirror.read_back() == fresh_content(device(), mesh, settings));
    };
    for (int round = 0; round < 8; ++round) {
      const Mesh before = mesh;
      for (int i = 0; i < 1 + 4 * round; ++i)
        edit(mesh, random);
      deltas.push_back(difference(before, mesh));
      expect_mirrored();
    }
    for (auto delta = deltas.rbegin(); delta != deltas.rend(); ++delta) {
      revert(mesh, *delta);
      expect_mirrored();
    }
    for (const MeshDelta& delta : deltas) {
      apply(mesh, delta);
      if (random() % 2 == 0) expect_mirrored();  // apply several changes at once
    }
    expect_mirrored();
  }
}

TEST_F(GpuMeshTest, OneCollapseAndItsUndoUploadFewBytes) {
  std::mt19937 random(9);
  for (const Settings& settings : {kFlat, kGouraud, kSplit}) {
    Mesh mesh = build_mesh(test::join(test::torus(100, 100), test::grid(30))).mesh;
    GpuMesh mirror(device());
    mirror.apply(mesh, settings);
    const Mesh before = mesh;
    collapse_any(mesh, random);
    const MeshDelta delta = difference(before, mesh);
    const UploadStats stats = mirror.apply(mesh, settings);
    EXPECT_GT(stats.uploaded_bytes, sizeof(glm::vec3));
    EXPECT_LT(stats.uploaded_bytes, 3000U);
    EXPECT_GT(stats.total_bytes, 400'000U);
    revert(mesh, delta);
    EXPECT_LT(mirror.apply(mesh, settings).uploaded_bytes, 3000U);
    EXPECT_EQ(mirror.read_back(), fresh_content(device(), mesh, settings));
  }
}

TEST_F(GpuMeshTest, UploadIsProportionalToTheEdit) {
  Mesh mesh = build_mesh(test::torus(100, 100)).mesh;
  GpuMesh mirror(device());
  mirror.apply(mesh, kFlat);
  std::mt19937 random(10);
  std::uint64_t before = 0;
  for (const int collapses : {1, 10, 100, 1000}) {
    for (int i = 0; i < collapses; ++i)
      collapse_any(mesh, random);
    const UploadStats stats = mirror.apply(mesh, kFlat);
    EXPECT_LT(stats.uploaded_bytes, 300U * collapses);
    EXPECT_GT(stats.uploaded_bytes, 3 * before);
    EXPECT_LT(2 * stats.uploaded_bytes, stats.total_bytes);
    before = stats.uploaded_bytes;
  }
}

TEST_F(GpuMeshTest, OneSharpnessAndItsUndoUploadFewBytes) {
  for (const Settings& settings : {kFlat, kGouraud, kSplit}) {
    Mesh mesh = build_mesh(test::torus(100, 100)).mesh;
    std::vector<EdgeSharpness> some;
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); i += 999)
      some.push_back({mesh.edge(Halfedge(i)), 1.0F});
    apply(mesh, sharpness_difference(mesh, some));
    GpuMesh mirror(device());
    mirror.apply(mesh, settings);
    for (EdgeSharpness& one : some)
      one.sharpness = 3.5F;  // the class stays the same, the weight changes
    some.resize(5);
    const MeshDelta delta = sharpness_difference(mesh, some);
    apply(mesh, delta);
    const UploadStats stats = mirror.apply(mesh, settings);
    EXPECT_GT(stats.uploaded_bytes, 5 * sizeof(Line));
    EXPECT_LT(stats.uploaded_bytes, 3000U);
    EXPECT_EQ(mirror.read_back(), fresh_content(device(), mesh, settings));
    revert(mesh, delta);
    EXPECT_LT(mirror.apply(mesh, settings).uploaded_bytes, 3000U);
    EXPECT_EQ(mirror.read_back(), fresh_content(device(), mesh, settings));
  }
}

TEST_F(GpuMeshTest, KeepsMarkedEdgesUntilTheMeshChanges) {
  Mesh mesh = build_mesh(test::cube()).mesh;
  GpuMesh mirror(device());
  mirror.apply(mesh, kFlat);
  const std::vector<std::byte> unmarked = mirror.read_back();
  const MarkedEdges marked{{Edge(0), Edge(2)}, Edge(5)};
  EXPECT_FALSE(mirror.mark({}));
  EXPECT_TRUE(mirror.mark(marked));
  EXPECT_FALSE(mirror.mark(marked));
  EXPECT_EQ(mirror.selected_count(), 2U);
  EXPECT_TRUE(mirror.has_hovered());
  EXPECT_EQ(mirror.read_back(), unmarked) << "marks are not part of the mesh";
  mirror.invalidate();
  mirror.apply(mesh, kFlat);
  EXPECT_EQ(mirror.selected_count(), 0U);
  EXPECT_FALSE(mirror.has_hovered());
}

TEST_F(GpuMeshTest, GrowthBeyondTheBuffersReallocates) {
  for (const Settings& settings : {kFlat, kGouraud, kSplit}) {
    Mesh mesh = build_mesh(test::cube()).mesh;
    GpuMesh mirror(device());
    mirror.apply(mesh, settings);
    const Mesh large = build_mesh(test::torus(20, 10)).mesh;
    apply(mesh, difference(mesh, large));
    mirror.apply(mesh, settings);
    EXPECT_EQ(mirror.read_back(), fresh_content(device(), large, settings));
  }
}

TEST_F(GpuMeshTest, NormalsFollowTheirWeight) {
  constexpr std::array kWeights{NormalWeight::angle, NormalWeight::area, NormalWeight::uniform};
  // By corner, but with no edge of the cube above the angle.
  const Settings by_corner{.shading = Shading::gouraud, .crease_angle_deg = 120.0F};
  for (Settings settings : {kGouraud, by_corner}) {
    Mesh mesh = io::read_model(MESHER_SOURCE_DIR "/assets/uneven_cube.obj").mesh;
    GpuMesh mirror(device());
    std::set<std::vector<std::byte>> contents;
    for (const NormalWeight weight : kWeights) {
      settings.normal_weight = weight;
      mirror.apply(mesh, settings);
      contents.insert(mirror.read_back());
      EXPECT_EQ(mirror.read_back(), fresh_content(device(), mesh, settings));
    }
    EXPECT_EQ(contents.size(), kWeights.size()) << "each weight gives other normals";
    // The normals that an edit recomputes have the same weights.
    mesh.set_position(Vertex(0), mesh.position(Vertex(0)) * 1.25F);
    mirror.apply(mesh, settings);
    EXPECT_EQ(mirror.read_back(), fresh_content(device(), mesh, settings));
  }
}

TEST_F(GpuMeshTest, OneMovedVertexUploadsFewBytes) {
  Mesh mesh = build_mesh(test::torus(100, 100)).mesh;
  GpuMesh mirror(device());
  mirror.apply(mesh, kGouraud);
  mesh.set_position(Vertex(1234), {0, 0, 0});
  const UploadStats stats = mirror.apply(mesh, kGouraud);
  EXPECT_GT(stats.uploaded_bytes, sizeof(glm::vec3));
  EXPECT_LT(stats.uploaded_bytes, 400U);  // including the normals of its ring
  EXPECT_GT(stats.total_bytes, 400'000U);
  const UploadStats nothing = mirror.apply(mesh, kGouraud);
  EXPECT_EQ(nothing.uploaded_bytes, 0U);
  EXPECT_EQ(nothing.ranges, 0U);
}

TEST_F(GpuMeshTest, ManyRangesBecomeOneCopy) {
  Mesh mesh = build_mesh(test::grid(450)).mesh;
  GpuMesh mirror(device());
  mirror.apply(mesh, kFlat);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); v += 8) {
    mesh.set_position(Vertex(v), mesh.position(Vertex(v)) + glm::vec3(0, 0, 1));
  }
  const UploadStats stats = mirror.apply(mesh, kFlat);
  EXPECT_EQ(stats.ranges, 1U);
  EXPECT_EQ(mirror.read_back(), fresh_content(device(), mesh, kFlat));
}

TEST_F(GpuMeshTest, CreatesNormalsOnlyForGouraud) {
  Mesh mesh = build_mesh(test::cube()).mesh;
  GpuMesh mirror(device());
  mirror.apply(mesh, kFlat);
  EXPECT_EQ(mirror.normals().mode(), GpuNormals::Mode::none);
  mirror.apply(mesh, kGouraud);
  EXPECT_EQ(mirror.normals().mode(), GpuNormals::Mode::vertex);
  EXPECT_EQ(mirror.normals().buffer().size(), 8U * 4);
  mirror.apply(mesh, kSplit);
  EXPECT_EQ(mirror.normals().mode(), GpuNormals::Mode::corner);
  EXPECT_EQ(mirror.normals().buffer().size(), 36U * 4);
  mirror.apply(mesh, kGouraud);
  mesh.set_sharpness(mesh.edge(Halfedge(0)), 1.0F);
  mirror.apply(mesh, kGouraud);
  EXPECT_EQ(mirror.normals().mode(), GpuNormals::Mode::corner) << "a crease splits normals";
  EXPECT_EQ(mirror.crease_count(), 1U);
  mirror.apply(mesh, kFlat);
  EXPECT_EQ(mirror.normals().buffer().size(), 0U);
}

TEST_F(GpuMeshTest, AcceptsAnEmptyMeshAndAReplacement) {
  GpuMesh mirror(device());
  Mesh empty;
  mirror.apply(empty, kGouraud);
  EXPECT_EQ(mirror.face_count(), 0U);
  EXPECT_TRUE(mirror.read_back().empty());
  Mesh mesh = build_mesh(test::cube()).mesh;
  mirror.apply(mesh, kGouraud);
  EXPECT_EQ(mirror.read_back(), fresh_content(device(), mesh, kGouraud));
  Mesh other = build_mesh(test::cube()).mesh;
  other.set_position(Vertex(0), {-2, -2, -2});
  other.changes().clear();
  mirror.invalidate();
  mirror.apply(other, kGouraud);
  EXPECT_EQ(mirror.read_back(), fresh_content(device(), other, kGouraud));
}

}  // namespace
}  // namespace mesher::render
