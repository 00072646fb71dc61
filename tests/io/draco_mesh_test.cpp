#include "engine/io/draco_mesh.h"

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "engine/core/error.h"
#include "engine/io/read.h"
#include "tests/support/gltf_document.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::GltfDocument;
using test::TempFolder;

int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type kind, draco::DataType type,
                  std::int8_t components, bool is_normalized, const void* values,
                  std::uint32_t points) {
  const std::int64_t stride = draco::DataTypeLength(type) * components;
  draco::GeometryAttribute attribute;
  attribute.Init(kind, nullptr, static_cast<std::uint8_t>(components), type, is_normalized, stride,
                 0);
  const int id = mesh.AddAttribute(attribute, true, points);
  for (std::uint32_t p = 0; p < points; ++p) {
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(p),
                                          static_cast<const char*>(values) + p * stride);
  }
  return id;
}

/// A grid of n x n squares with positions, and bytes as colors, compressed without quantization.
std::string draco_grid(std::uint32_t n) {
  draco::Mesh mesh;
  std::vector<float> positions;
  std::vector<std::uint8_t> colors;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      positions.insert(positions.end(), {float(x), float(y), 0.25F});
      colors.insert(colors.end(), {255, std::uint8_t(x), 51, 255});
    }
  }
  const auto points = static_cast<std::uint32_t>(positions.size() / 3);
  mesh.set_num_points(points);
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x;
      for (const auto& f :
           {std::array<std::uint32_t, 3>{a, a + 1, a + n + 2}, {a, a + n + 2, a + n + 1}}) {
        mesh.AddFace({draco::PointIndex(f[0]), draco::PointIndex(f[1]), draco::PointIndex(f[2])});
      }
    }
  }
  add_attribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, false,
                positions.data(), points);
  add_attribute(mesh, draco::GeometryAttribute::COLOR, draco::DT_UINT8, 4, false, colors.data(),
                points);
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

/// A glTF file of that grid.
std::string draco_document(const std::string& packed, std::uint32_t n,
                           const std::string& attributes = R"("POSITION":0,"COLOR_0":1)") {
  GltfDocument document;
  const int view = document.view(packed);
  const std::size_t points = std::size_t{n + 1} * (n + 1);
  document.accessor("", 5126, "VEC3", points);
  document.accessor(R"("normalized":true)", 5121, "VEC4", points);
  document.accessor("", 5125, "SCALAR", std::size_t{6} * n * n);
  return document.text(
      R"("extensionsRequired":["KHR_draco_mesh_compression"],"nodes":[{"mesh":0},{"mesh":0,"translation":[0,0,9]}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"indices":2,"extensions":
      {"KHR_draco_mesh_compression":{"bufferView":)" +
      std::to_string(view) + R"(,"attributes":{)" + attributes + "}}}}]}]");
}

std::string draco_refusal(const std::string& text) {
  const TempFolder folder;
  try {
    read_soup(folder.write("m.gltf", text));
  } catch (const InputError& error) {
    return error.reason();
  }
  return "was not refused";
}

TEST(Draco, DecodesAMeshWithItsAttributes) {
  const std::uint32_t ids[] = {1, 0};
  std::string problem;
  const std::optional<DracoMesh> mesh = decode_draco(draco_grid(20), ids, problem);
  ASSERT_TRUE(mesh) << problem;
  EXPECT_EQ(mesh->points, 441U);
  EXPECT_EQ(mesh->indices.size(), 2400U);
  ASSERT_EQ(mesh->attributes.size(), 2U);
  EXPECT_EQ(mesh->attributes[0].components, 4U);
  EXPECT_EQ(mesh->attributes[1].components, 3U);
  EXPECT_EQ(mesh->attributes[0].values[0], 255.0F);
}

TEST(Draco, GltfIsReadWithEachInstance) {
  const TempFolder folder;
  const Soup soup = read_soup(folder.write("m.gltf", draco_document(draco_grid(20), 20)));
  EXPECT_EQ(soup.face_count(), 1600U);
  EXPECT_EQ(soup.positions.size(), 882U);
  double height = 0.0;
  for (const glm::vec3& p : soup.positions)
    height = std::max(height, double(p.z));
  EXPECT_EQ(height, 9.25);
  for (std::size_t c = 0; c < soup.corners.size(); ++c) {
    EXPECT_EQ(soup.attributes.color[c].r, 255);
    EXPECT_EQ(soup.attributes.color[c].g, std::uint8_t(soup.positions[soup.corners[c]].x));
    if (testing::Test::HasFailure()) break;
  }
}

TEST(Draco, RefusesWhatDoesNotFit) {
  const std::string grid = draco_grid(4);
  const auto is_refused = [](const std::string& text, const std::string& reason) {
    EXPECT_NE(draco_refusal(text).find(reason), std::string::npos) << draco_refusal(text);
  };
  is_refused(draco_document("not Draco data at all", 4), "damaged");
  is_refused(draco_document(grid.substr(0, grid.size() / 2), 4), "Draco data");
  is_refused(draco_document(grid, 4, R"("POSITION":7)"), "damaged");
  is_refused(draco_document(grid, 4, R"("COLOR_0":1)"), "no positions");
  is_refused(draco_document(grid, 4, R"("POSITION":-1)"), "not an integer");
}

// Whatever the bytes do to the decoder, the result is a mesh or one line.
TEST(Draco, MutatedDataIsReadOrRefused) {
  std::mt19937 random(9);
  const std::string grid = draco_grid(6);
  const std::uint32_t ids[] = {0};
  for (int i = 0; i < 150; ++i) {
    std::string bytes = grid;
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    if (i % 3 == 0) bytes.resize(random() % bytes.size());
    std::string problem;
    const std::optional<DracoMesh> mesh = decode_draco(bytes, ids, problem);
    EXPECT_NE(mesh.has_value(), !problem.empty());
    for (std::size_t c = 0; mesh && c < mesh->indices.size(); ++c)
      EXPECT_LT(mesh->indices[c], mesh->points);
  }
}

}  // namespace
}  // namespace mesher::io
