// Files that version 1 of the format wrote. Their content and their bytes must not change.
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <iterator>
#include <span>
#include <string>

#include "engine/progressive/codec/pm_format.h"
#include "tests/progressive/codec/pm_files.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace mesher::test {
namespace {

Bytes golden(const std::string& name) {
  const std::string text =
      read_bytes(std::filesystem::path(MESHER_SOURCE_DIR) / "tests/golden" / name);
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// A base of 40 faces with a boundary and creases, and 56 splits.
void examine(const std::string& name, unsigned coordinate_bits, double sum) {
  const Bytes bytes = golden(name);
  ReadBack read = read_back(bytes);
  ASSERT_EQ(read.error, "");
  EXPECT_EQ(read.damage, "");
  EXPECT_TRUE(read.is_complete);
  EXPECT_EQ(read.mesh.split_count(), 56U);
  const Mesh& mesh = read.mesh.mesh();
  EXPECT_EQ(mesh.vertex_count(), 81U);
  EXPECT_EQ(mesh.face_count(), 128U);
  expect_valid(mesh);
  double found = 0.0;
  for (const glm::vec3& p : mesh.positions())
    found += double{p.x} + 2.0 * double{p.y} + 3.0 * double{p.z};
  EXPECT_NEAR(found, sum, 1e-5);
  if (coordinate_bits == 0) {
    EXPECT_EQ(written(read.mesh), bytes);
  }
}

TEST(PmGolden, ExactFileIsUnchanged) {
  examine("hypersheet_exact.pm", 0, 5.401304);
}

TEST(PmGolden, GridFileIsUnchanged) {
  examine("hypersheet_grid.pm", 10, 5.392127);
}

TEST(PmFormat, ChecksumsMatchThoseOfPng) {
  const std::string digits = "123456789";
  const auto bytes = std::as_bytes(std::span(digits));
  EXPECT_EQ(progressive::pm_check(0, bytes), 0xCBF43926U);
  for (std::size_t i = 0; i <= digits.size(); ++i)
    EXPECT_EQ(progressive::pm_check(progressive::pm_check(0, bytes.first(i)), bytes.subspan(i)),
              0xCBF43926U);
}

TEST(PmFormat, OrderedFloatsRoundTripAndSort) {
  const float values[] = {-3e38F, -1.0F, -1e-45F, -0.0F, 0.0F, 1e-45F, 2.5F, 3e38F};
  for (std::size_t i = 0; i < std::size(values); ++i) {
    EXPECT_EQ(
        std::bit_cast<std::uint32_t>(progressive::pm_float(progressive::pm_ordered(values[i]))),
        std::bit_cast<std::uint32_t>(values[i]));
    if (i > 0) {
      EXPECT_LT(progressive::pm_ordered(values[i - 1]), progressive::pm_ordered(values[i]));
    }
  }
}

}  // namespace
}  // namespace mesher::test
