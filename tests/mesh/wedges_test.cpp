#include "engine/mesh/wedges.h"

#include <gtest/gtest.h>

#include <numeric>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/mesh/corner_attributes.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// A stream with a number per corner.
AttributeStream stream_of(const std::string& name, const std::vector<float>& values,
                          const std::vector<std::uint32_t>& index) {
  AttributeStream stream;
  stream.layers.emplace_back(AttributeType{AttributeKind::custom, name}, std::span(values));
  stream.index.assign(index.begin(), index.end());
  return stream;
}

std::vector<std::uint32_t> origins(const Mesh& mesh) {
  std::vector<std::uint32_t> index;
  for (const Vertex v : mesh.origins())
    index.push_back(v.index());
  return index;
}

TEST(Wedges, MeshWithoutSeamsNeedsNoIds) {
  const Mesh mesh = built(grid(3)).mesh;
  std::vector<float> values(mesh.vertex_count());
  std::iota(values.begin(), values.end(), 0.0F);
  const Attributes a = make_wedges(mesh, {stream_of("_A", values, origins(mesh))});
  EXPECT_TRUE(validate(mesh, a).empty());
  EXPECT_FALSE(a.has_seams());
  EXPECT_TRUE(a.corner_wedge.empty());
  EXPECT_TRUE(std::ranges::equal(a.find("_A")->values<float>(), values));
}

TEST(Wedges, EqualValuesShareAWedgeWhereverTheyAre) {
  const Mesh mesh = built(grid(2)).mesh;
  // One value per corner, equal around each vertex.
  std::vector<float> values;
  for (const Vertex v : mesh.origins())
    values.push_back(static_cast<float>(v.index() / 2));
  std::vector<std::uint32_t> index(values.size());
  std::iota(index.begin(), index.end(), 0U);
  EXPECT_FALSE(make_wedges(mesh, {stream_of("_A", values, index)}).has_seams());
}

TEST(Wedges, SeamGivesEachSideAWedge) {
  const Mesh mesh = built(grid(2)).mesh;
  std::vector<float> of_face;
  std::vector<std::uint32_t> index;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    of_face.push_back(h < 12 ? 0.0F : 1.0F);  // the lower and the upper row
    index.push_back(h);
  }
  const Attributes a = make_wedges(mesh, {stream_of("_A", of_face, index)});
  EXPECT_TRUE(validate(mesh, a).empty());
  EXPECT_EQ(a.further.size(), 3U) << "the middle row of vertices";
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const Wedge w = a.wedge(mesh.origins(), Halfedge(h));
    EXPECT_EQ(a.layers[0].values<float>()[w.index()], of_face[h]) << h;
  }
}

TEST(Wedges, CornersWithoutAValueAreApart) {
  const Mesh mesh = built(grid(1)).mesh;
  std::vector<std::uint32_t> index = origins(mesh);
  index[0] = kNone;
  const Attributes a = make_wedges(mesh, {stream_of("_A", {1, 2, 3, 4}, index)});
  EXPECT_TRUE(validate(mesh, a).empty());
  EXPECT_EQ(a.further.size(), 1U);
  EXPECT_TRUE(is_absent(a.layers[0], a.wedge(mesh.origins(), Halfedge(0)).index()));
}

TEST(Wedges, ManyWedgesOfOneVertexAreFound) {
  // A fan of 3,000 faces, whose corners at the hub have 1,000 values.
  constexpr std::uint32_t kFaces = 3'000;
  Soup soup;
  soup.positions.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i < kFaces; ++i) {
    const float angle = 6.2831853F * float(i) / kFaces;
    soup.positions.push_back({std::cos(angle), std::sin(angle), 0});
    soup.corners.insert(soup.corners.end(), {0, 1 + i, 1 + (i + 1) % kFaces});
  }
  const Mesh mesh = built(std::move(soup)).mesh;
  std::vector<float> values(1'000);
  std::iota(values.begin(), values.end(), 0.0F);
  std::vector<std::uint32_t> index(mesh.halfedge_count(), 0);
  for (std::uint32_t f = 0; f < kFaces; ++f)
    index[3 * f] = f % 1'000;
  const Attributes a = make_wedges(mesh, {stream_of("_A", values, index)});
  EXPECT_TRUE(validate(mesh, a).empty());
  EXPECT_EQ(a.further.size(), 999U);
  for (std::uint32_t f = 0; f < kFaces; ++f) {
    const Wedge w = a.wedge(mesh.origins(), Mesh::halfedge(Face(f)));
    EXPECT_EQ(a.layers[0].values<float>()[w.index()], values[f % 1'000]);
  }
}

TEST(Wedges, StreamsTogetherSeparateWedges) {
  const Mesh mesh = built(grid(2)).mesh;
  std::vector<std::uint32_t> rows;
  std::vector<std::uint32_t> columns;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    rows.insert(rows.end(), 3, f / 4);
    columns.insert(columns.end(), 3, f / 2 % 2);
  }
  const Attributes a =
      make_wedges(mesh, {stream_of("_A", {5, 6}, rows), stream_of("_B", {7, 8}, columns)});
  EXPECT_TRUE(validate(mesh, a).empty());
  EXPECT_EQ(a.further.size(), 3U + 4U) << "four in the middle, two at each middle of a side";
}

TEST(Wedges, DoNotDependOnThreads) {
  const Mesh mesh = built(torus(200, 150)).mesh;
  std::vector<float> values;
  std::vector<std::uint32_t> index;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    values.push_back(float(h / 3 % 7));
    index.push_back(h);
  }
  Attributes results[2];
  for (const unsigned threads : {1U, 2U}) {
    const ThreadLimit limit(threads);
    results[threads - 1] = make_wedges(mesh, {stream_of("_A", values, index)});
  }
  EXPECT_EQ(results[0].corner_wedge, results[1].corner_wedge);
  EXPECT_EQ(results[0].further, results[1].further);
  EXPECT_EQ(results[0].layers[0].bytes(), results[1].layers[0].bytes());
}

TEST(Wedges, LayersAreAddedAndReplaced) {
  const Mesh mesh = built(grid(2)).mesh;
  CornerAttributes corners;
  corners.texcoord.assign(mesh.halfedge_count(), {0.5F, 0.5F});
  Attributes a = to_wedges(mesh, std::move(corners));
  Array<glm::vec3> normals(mesh.halfedge_count(), glm::vec3(0, 0, 1));
  normals[0] = {1, 0, 0};
  set_normals(mesh, a, normals);
  EXPECT_TRUE(validate(mesh, a).empty());
  EXPECT_EQ(a.layers.size(), 2U);
  EXPECT_TRUE(a.has_seams());
  EXPECT_EQ(to_corners(mesh, a).normal, normals);
  normals[0] = {0, 0, 1};
  set_normals(mesh, a, normals);
  EXPECT_EQ(a.layers.size(), 2U);
  EXPECT_FALSE(a.has_seams()) << "nothing separates the wedges any more";
  EXPECT_TRUE(validate(mesh, a).empty());
}

TEST(Wedges, CanceledWorkThrows) {
  const Mesh mesh = built(torus(30, 20)).mesh;
  Progress progress;
  progress.cancel();
  const std::vector<float> values(mesh.vertex_count());
  EXPECT_THROW((void)make_wedges(mesh, {stream_of("_A", values, origins(mesh))}, &progress),
               Cancelled);
}

TEST(ValidateAttributes, NamesEachBrokenInvariant) {
  const Mesh mesh = built(grid(2)).mesh;
  CornerAttributes corners;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h)
    corners.texcoord.push_back({h < 12 ? 0.0F : 1.0F, 0.0F});
  corners.group.assign(mesh.face_count(), 0);
  corners.groups = test::named_groups({"all"});
  const Attributes good = to_wedges(mesh, std::move(corners));
  ASSERT_TRUE(validate(mesh, good).empty());
  const auto broken = [&](auto&& harm) {
    Attributes a = good;
    harm(a);
    const std::vector<Violation> found = validate(mesh, a);
    return found.empty() ? 0 : found.front().invariant;
  };
  EXPECT_EQ(broken([](Attributes& a) { a.corner_wedge.pop_back(); }), 15);
  EXPECT_EQ(broken([](Attributes& a) { a.layers[0].resize(3); }), 16);
  EXPECT_EQ(broken([](Attributes& a) { a.layers.push_back(a.layers[0]); }), 16);
  EXPECT_EQ(broken([](Attributes& a) { std::swap(a.corner_wedge[0], a.corner_wedge[1]); }), 17);
  EXPECT_EQ(broken([](Attributes& a) { a.corner_wedge[0] = Wedge(99); }), 17);
  EXPECT_EQ(broken([](Attributes& a) {
              for (Wedge& w : a.corner_wedge) {
                if (w == Wedge(9)) w = Wedge(a.further[0].index());
              }
            }),
            18);
  EXPECT_EQ(broken([](Attributes& a) { a.group[0] = 1; }), 19);
}

}  // namespace
}  // namespace mesher::test
