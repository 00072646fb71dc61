#include "engine/io/join.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "engine/core/parallel.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "engine/mesh/statistics.h"
#include "tests/support/attributes.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::TempFolder;

Array<glm::vec3> points(std::initializer_list<glm::vec3> list) {
  Array<glm::vec3> positions;
  positions.assign(list);
  return positions;
}

/// Joined positions as a list: for each position, the first one that it is joined with.
std::vector<std::uint32_t> firsts(const Array<glm::vec3>& positions, double distance) {
  BuildReport report;
  const std::optional<Weld> joined = joined_positions(positions, distance, report);
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < positions.size(); ++i)
    list.push_back(joined ? joined->first[joined->index[i]] : i);
  return list;
}

/// n quads in a row, each with four vertices of its own.
std::string loose_quads(int n) {
  std::string text;
  for (int i = 0; i < n; ++i) {
    const std::string left = std::to_string(i);
    const std::string right = std::to_string(i + 1);
    text += "v " + left + " 0 0\nv " + right + " 0 0\nv " + right + " 1 0\nv " + left + " 1 0\n";
    text += "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
  }
  for (int i = 0; i < n; ++i) {
    text += "f";
    for (int c = 1; c <= 4; ++c)
      text += " " + std::to_string(4 * i + c) + "/" + std::to_string(4 * i + c);
    text += "\n";
  }
  return text;
}

TEST(Join, EqualPositionsAndZeroOfEitherSign) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(
      firsts(points({{0, 1, 2}, {3, 4, 5}, {-0.0F, 1, 2}, {3, 4, 5}, {3, 4, 5.0000005F}}), 0.0),
      (std::vector<std::uint32_t>{0, 1, 0, 1, 4}));
  EXPECT_EQ(firsts(points({{nan, 0, 0}, {nan, 0, 0}}), 0.0), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(firsts(points({{nan, 0, 0}, {nan, 0, 0}}), 1.0), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(firsts({}, 0.0), std::vector<std::uint32_t>{});
}

// The fast test for equal positions must find all of them among many different ones.
TEST(Join, FindsFewAndManyEqualPositionsAsSortingDoes) {
  std::mt19937 random(1);
  for (const int range : {3, 30, 300, 3000}) {
    Array<glm::vec3> positions;
    for (int i = 0; i < 20000; ++i) {
      const auto coordinate = [&] { return float(int(random() % unsigned(range))) / 7.0F; };
      positions.push_back({coordinate(), coordinate(), coordinate()});
    }
    const Weld expected = weld_positions(positions);
    BuildReport report;
    const std::optional<Weld> joined = joined_positions(positions, 0.0, report);
    EXPECT_EQ(report[Repair::vertices_joined], positions.size() - expected.first.size());
    if (!joined) continue;
    EXPECT_EQ(joined->index, expected.index);
    EXPECT_EQ(joined->first, expected.first);
  }
}

TEST(Join, WithinADistanceTheNearestVertexIsJoined) {
  EXPECT_EQ(firsts(points({{0, 0, 0}, {1, 0, 0}, {0.4F, 0, 0}, {0.6F, 0, 0}, {0, 0.5F, 0}}), 0.5),
            (std::vector<std::uint32_t>{0, 1, 0, 1, 0}));
  EXPECT_EQ(firsts(points({{-0.01F, 0, 0}, {0.01F, 0, 0}}), 0.1),
            (std::vector<std::uint32_t>{0, 0}))
      << "across the border of a cell";
  EXPECT_EQ(firsts(points({{3e38F, 0, 0}, {-3e38F, 0, 0}, {3e38F, 0, 0}}), 1e-45),
            (std::vector<std::uint32_t>{0, 1, 0}));
}

// However long a chain of close positions is, none moves by more than the distance.
TEST(Join, ChainsDoNotCollapse) {
  Array<glm::vec3> positions;
  for (int i = 0; i <= 1000; ++i)
    positions.push_back({0.01F * float(i), 0, 0});
  BuildReport report;
  const std::optional<Weld> joined = joined_positions(positions, 0.1, report);
  ASSERT_TRUE(joined);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_LE(std::abs(positions[i].x - positions[joined->first[joined->index[i]]].x), 0.1001F);
  }
  EXPECT_GE(joined->first.size(), 50U);
  EXPECT_LE(joined->first.size(), 100U);
  EXPECT_EQ(report[Repair::close_vertices_joined], positions.size() - joined->first.size());
}

TEST(Join, ManyPositionsInOnePlaceAreFast) {
  Array<glm::vec3> positions;
  for (int i = 0; i < 300000; ++i)
    positions.push_back({float(i % 100) * 1e-6F, 0, 0});
  BuildReport report;
  EXPECT_EQ(joined_positions(positions, 0.5, report)->first.size(), 1U);
  EXPECT_EQ(joined_positions(positions, 0.0, report)->first.size(), 100U);
}

// The same surface, whatever the format, and the same bytes on any number of threads.
TEST(Join, DoesNotDependOnTheFormat) {
  const TempFolder folder;
  const Model loose = read_model(folder.write("in.obj", loose_quads(40)), {.weld = std::nullopt});
  ASSERT_EQ(statistics(loose.mesh).components, 40U);
  for (const char* name : {"m.obj", "m.ply", "m.off", "m.stl", "m.gltf", "m.glb"}) {
    SCOPED_TRACE(name);
    write_model(folder / name, loose.mesh, loose.attributes);
    const Model joined = read_model(folder / name);
    EXPECT_EQ(statistics(joined.mesh).components, 1U);
    EXPECT_EQ(joined.mesh.vertex_count(), 82U);
    EXPECT_GT(joined.report[Repair::vertices_joined], 0U);
    const Model apart = read_model(folder / name, {.weld = std::nullopt});
    EXPECT_EQ(apart.report[Repair::vertices_joined], 0U);
    EXPECT_GE(statistics(apart.mesh).components, 40U);
    const ThreadLimit one(1);
    EXPECT_EQ(read_model(folder / name).mesh.positions().size(), joined.mesh.positions().size());
  }
}

TEST(Join, AttributesStayApart) {
  const TempFolder folder;
  const Model model = read_model(folder.write("in.obj", loose_quads(2)));
  ASSERT_EQ(model.mesh.vertex_count(), 6U);
  const Array<glm::vec2> texcoord = test::corners_of(model).texcoord;
  std::size_t seams = 0;
  for (std::uint32_t h = 0; h < model.mesh.halfedge_count(); ++h) {
    const Halfedge twin = model.mesh.twin(Halfedge(h));
    if (!twin.is_valid()) continue;
    const glm::vec2 here = texcoord[h];
    const glm::vec2 there = texcoord[Mesh::next(twin).index()];
    seams += here != there ? 1 : 0;
  }
  EXPECT_EQ(seams, 2U) << "both ends of the joined edge, from both sides, once each way";
}

TEST(Join, CreasesFollowTheirVertices) {
  const TempFolder folder;
  const Model model =
      read_model(folder.write("in.obj", loose_quads(2) + "e 4 7 2\nt corner 1/1/0 7 3\n"));
  EXPECT_EQ(statistics(model.mesh).crease_edges, 1U);
  EXPECT_EQ(model.mesh.sharpness(Vertex(2)), 3.0F) << "vertex 7 of the file is at vertex 2";
}

}  // namespace
}  // namespace mesher::io
