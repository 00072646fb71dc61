// Writes and reads progressive meshes and compares them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <stdexcept>
#include <string>

#include "engine/core/error.h"
#include "engine/io/read.h"
#include "engine/progressive/build.h"
#include "engine/progressive/codec/pm_read.h"
#include "engine/progressive/codec/pm_write.h"
#include "tests/progressive/checks.h"
#include "tests/progressive/codec/pm_files.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

void expect_lossless(progressive::ProgressiveMesh& mesh) {
  const std::uint32_t level = mesh.split_count() / 3;
  mesh.go_to(level);
  const Bytes bytes = written(mesh);
  EXPECT_EQ(mesh.level(), level);
  EXPECT_EQ(bytes, written(mesh));
  ReadBack read = read_back(bytes);
  ASSERT_EQ(read.error, "");
  EXPECT_EQ(read.damage, "");
  ASSERT_TRUE(read.is_complete);
  EXPECT_EQ(read.mesh.level(), mesh.split_count());
  expect_same(mesh, read.mesh);
  for (const std::uint32_t at : some_levels(mesh, 12)) {
    mesh.go_to(at);
    read.mesh.go_to(at);
    EXPECT_TRUE(is_identical(without_copies(mesh.mesh()), read.mesh.mesh())) << at;
  }
  EXPECT_EQ(written(read.mesh), bytes);
}

/// Step of the quantization grid, computed from a box over all levels.
float step_of(progressive::ProgressiveMesh& mesh, unsigned bits) {
  mesh.go_to(0);
  glm::dvec3 low(INFINITY);
  glm::dvec3 high(-INFINITY);
  const auto add = [&](const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  };
  for (const glm::vec3& p : mesh.mesh().positions())
    add(p);
  for (const progressive::VertexSplit& s : mesh.splits()) {
    add(s.fine_position);
    add(s.child_position);
  }
  const glm::dvec3 size = high - low;
  return static_cast<float>(std::max({size.x, size.y, size.z}) / ((1U << bits) - 1));
}

void expect_near(const Mesh& a, const Mesh& b, float step) {
  ASSERT_TRUE(is_equal(a.origins(), b.origins()));
  ASSERT_TRUE(is_equal(a.twins(), b.twins()));
  for (std::uint32_t v = 0; v < a.vertex_count(); ++v) {
    for (int i = 0; i < 3; ++i) {
      const float x = a.position(Vertex(v))[i];
      ASSERT_NEAR(x, b.position(Vertex(v))[i], 0.501F * step + 1e-6F * std::abs(x));
    }
  }
}

void expect_quantized(progressive::ProgressiveMesh& mesh, unsigned bits) {
  ReadBack read = read_back(written(mesh, bits));
  ASSERT_EQ(read.error, "");
  ASSERT_TRUE(read.is_complete);
  ASSERT_EQ(read.mesh.split_count(), mesh.split_count());
  EXPECT_TRUE(is_equal(mesh.sharpnesses(), read.mesh.sharpnesses()));
  EXPECT_TRUE(is_equal(mesh.corner_sharpnesses(), read.mesh.corner_sharpnesses()));
  const float step = step_of(mesh, bits);
  for (const std::uint32_t at : some_levels(mesh, 12)) {
    mesh.go_to(at);
    read.mesh.go_to(at);
    expect_near(mesh.mesh(), read.mesh.mesh(), step);
    expect_valid_level(read.mesh);
  }
  const Bytes again = written(read.mesh, bits);
  ASSERT_EQ(read_back(again).error, "");
}

TEST(PmRoundTrip, IsExactForEveryKindOfMesh) {
  for (const auto& [name, mesh] : meshes_of_all_kinds()) {
    for (const simplify::Placement placement :
         {simplify::Placement::optimal, simplify::Placement::endpoint}) {
      SCOPED_TRACE(name);
      progressive::Progressive p =
          progressive::make_progressive(mesh, {.target_faces = 1, .placement = placement});
      expect_lossless(p.mesh);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(PmRoundTrip, FilesDoNotStoreBowTieCopies) {
  progressive::Progressive p = progressive::make_progressive(
      built(bow_tie({torus(12, 9), grid(6), cube()})).mesh, {.target_faces = 1});
  ASSERT_EQ(p.mesh.mesh().bow_tie_copies().size(), 3U);
  expect_lossless(p.mesh);
  EXPECT_EQ(p.mesh.mesh().bow_tie_copies().size(), 3U);
  EXPECT_TRUE(read_back(written(p.mesh)).mesh.mesh().bow_tie_copies().empty());
}

TEST(PmRoundTrip, IsExactWithoutSplits) {
  for (const auto& [name, mesh] : meshes_of_all_kinds()) {
    SCOPED_TRACE(name);
    progressive::ProgressiveMesh all_base{Mesh(mesh)};
    expect_lossless(all_base);
  }
}

TEST(PmRoundTrip, QuantizedPositionsAreTheNearestGridPoints) {
  for (const auto& [name, mesh] : meshes_of_all_kinds()) {
    for (const unsigned bits : {4U, 14U, 24U}) {
      SCOPED_TRACE(name + ", " + std::to_string(bits) + " bits");
      progressive::Progressive p = progressive::make_progressive(mesh, {.target_faces = 1});
      expect_quantized(p.mesh, bits);
    }
  }
}

TEST(PmRoundTrip, PieceSizeDoesNotMatter) {
  progressive::Progressive p =
      progressive::make_progressive(built(torus(40, 30)).mesh, {.target_faces = 20});
  for (const unsigned bits : {0U, 12U}) {
    const Bytes bytes = written(p.mesh, bits);
    ReadBack whole = read_back(bytes);
    for (const std::size_t piece : {1U, 7U, 100U, 4096U}) {
      ReadBack read = read_back(bytes, piece);
      ASSERT_TRUE(read.is_complete) << read.error << read.damage;
      expect_same(whole.mesh, read.mesh);
    }
  }
}

TEST(PmRoundTrip, FirstBytesGiveTheBase) {
  progressive::Progressive p =
      progressive::make_progressive(built(torus(100, 60)).mesh, {.target_faces = 60});
  const Bytes bytes = written(p.mesh, 14);
  progressive::PmReader reader("x.pm");
  EXPECT_FALSE(reader.has_base());
  reader.feed(std::span(bytes).first(2500));
  ASSERT_TRUE(reader.has_base());
  EXPECT_FALSE(reader.is_complete());
  EXPECT_EQ(reader.announced_splits(), p.mesh.split_count());
  EXPECT_EQ(reader.coordinate_bits(), 14U);
  EXPECT_GE(reader.mesh().split_count(), 64U);
  reader.mesh().go_to(3);
  reader.feed(std::span(bytes).subspan(2500));
  EXPECT_TRUE(reader.is_complete());
  EXPECT_EQ(reader.mesh().level(), p.mesh.split_count());
  EXPECT_EQ(reader.damage(), "");
}

TEST(PmRoundTrip, LargestFloatsKeepTheirPositions) {
  Soup soup = cube();
  for (glm::vec3& p : soup.positions)
    p *= 2.0F * std::numeric_limits<float>::max();
  progressive::Progressive p =
      progressive::make_progressive(built(std::move(soup)).mesh, {.target_faces = 4});
  expect_lossless(p.mesh);
  for (const unsigned bits : {4U, 13U, 24U}) {
    ReadBack read = read_back(written(p.mesh, bits));
    EXPECT_EQ(read.error, "");
    EXPECT_TRUE(read.is_complete);
  }
}

TEST(PmRoundTrip, CancelKeepsTheLevel) {
  progressive::Progressive p =
      progressive::make_progressive(built(torus(20, 12)).mesh, {.target_faces = 20});
  p.mesh.go_to(5);
  Progress progress;
  progress.cancel();
  EXPECT_THROW(progressive::write_pm(p.mesh, {.progress = &progress}, [](auto) {}), Cancelled);
  EXPECT_EQ(p.mesh.level(), 5U);
  EXPECT_THROW(progressive::write_pm(p.mesh, {}, [](auto) { throw std::runtime_error("full"); }),
               std::runtime_error);
  EXPECT_EQ(p.mesh.level(), 5U);
}

/// Checks size and exactness of the file of a large model.
void examine_scan(const Mesh& input) {
  progressive::Progressive p = progressive::make_progressive(input, {.target_faces = 200});
  const Bytes exact = written(p.mesh);
  ReadBack read = read_back(exact);
  ASSERT_TRUE(read.is_complete) << read.error << read.damage;
  expect_same(p.mesh, read.mesh);
  const std::size_t plain =
      12 * std::size_t{input.vertex_count()} + 12 * std::size_t{input.face_count()};
  EXPECT_LT(exact.size(), plain / 2);
  const Bytes small = written(p.mesh, 14);
  EXPECT_LT(8 * small.size(), 60 * std::size_t{input.vertex_count()});
  expect_quantized(p.mesh, 14);
}

TEST(PmRoundTrip, AssetsRoundTrip) {
  for (const char* name : {"bunny", "knot", "cactus", "hypersheet", "creased_cube"}) {
    SCOPED_TRACE(name);
    const auto file =
        std::filesystem::path(MESHER_SOURCE_DIR) / "assets" / (std::string(name) + ".obj");
    const Mesh mesh = io::read_model(file, {}).mesh;
    progressive::Progressive p = progressive::make_progressive(mesh, {.target_faces = 1});
    expect_lossless(p.mesh);
    expect_quantized(p.mesh, 14);
  }
}

class PmScan : public testing::TestWithParam<const char*> {};

TEST_P(PmScan, IsSmallAndExact) {
  const auto file =
      std::filesystem::path(MESHER_SHARED_MODELS) / (std::string(GetParam()) + ".obj");
  if (!std::filesystem::exists(file)) {
    std::cerr << "*** NOT TESTED: " << file << " is missing ***\n";
    return;
  }
  examine_scan(io::read_model(file, {}).mesh);
}

INSTANTIATE_TEST_SUITE_P(Shared, PmScan, testing::Values("armadillo", "bunny"));

}  // namespace
}  // namespace mesher::test
