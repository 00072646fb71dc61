#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/io/gltf_contents.h"
#include "engine/io/meshopt_view.h"
#include "engine/io/read.h"
#include "tests/support/gltf_document.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::bytes_of;
using test::GltfDocument;
using test::kSquareCorners;
using test::kSquareIndices;
using test::TempFolder;

const std::string kSquareMesh =
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";

Soup read_gltf_text(const std::string& text) {
  const TempFolder folder;
  return read_soup(folder.write("m.gltf", text));
}

std::string reason_of(const std::string& text) {
  try {
    read_gltf_text(text);
  } catch (const InputError& error) {
    return error.reason();
  }
  return "was not refused";
}

std::string number(int value) {
  return std::to_string(value);
}

/// A sparse accessor of four positions that moves vertex 2 to (5, 6, 7).
std::string sparse_square(const std::string& base, int index_type, const std::string& index,
                          std::size_t count = 4) {
  GltfDocument document;
  const int corners = document.view(bytes_of(kSquareCorners));
  const int at = document.view(index);
  const int values = document.view(bytes_of<float>({5, 6, 7}));
  document.accessor((base.empty() ? "" : R"("bufferView":)" + number(corners) + ",") +
                        R"("sparse":{"count":1,"indices":{"bufferView":)" + number(at) +
                        R"(,"componentType":)" + number(index_type) +
                        R"(},"values":{"bufferView":)" + number(values) + "}}",
                    5126, "VEC3", count);
  document.indices(kSquareIndices);
  return document.text(kSquareMesh);
}

TEST(GltfSparse, ReplacesValuesWithAndWithoutABase) {
  const Soup with = read_gltf_text(sparse_square("base", 5121, std::string(1, '\2')));
  EXPECT_EQ(with.positions[1], glm::vec3(1, 0, 0));
  EXPECT_EQ(with.positions[2], glm::vec3(5, 6, 7));
  for (const auto& [type, index] : {std::pair{5121, std::string(1, '\2')},
                                    {5123, std::string("\2\0", 2)},
                                    {5125, std::string("\2\0\0\0", 4)}}) {
    const Soup without = read_gltf_text(sparse_square("", type, index));
    EXPECT_EQ(without.positions.size(), 2U) << "three are zero, and joined";
    EXPECT_EQ(without.positions[1], glm::vec3(5, 6, 7));
  }
}

TEST(GltfSparse, RefusesDamage) {
  const auto is_refused = [](const std::string& text, const std::string& reason) {
    EXPECT_NE(reason_of(text).find(reason), std::string::npos) << reason_of(text);
  };
  is_refused(sparse_square("", 5121, std::string(1, '\4')), "out of range");
  is_refused(sparse_square("", 5126, std::string(4, '\0')), "not unsigned");
  is_refused(sparse_square("", 5125, std::string(1, '\0')), "past their buffer");
  is_refused(sparse_square("", 5121, std::string(1, '\0'), 4000000000), "too long");
  is_refused(sparse_square("", 5121, std::string(1, '\0'), 18446744073709551615U), "too long");
}

// KHR_mesh_quantization: positions and texture coordinates of any integer type.
TEST(GltfRead, ReadsEveryComponentType) {
  struct Type {
    int id;
    std::string zero_and_one;
    float plain;  ///< of the larger value
    double full;
  };
  const std::vector<Type> types = {{5120, bytes_of<std::int8_t>({0, 127}), 127, 127},
                                   {5121, bytes_of<std::uint8_t>({0, 255}), 255, 255},
                                   {5122, bytes_of<std::int16_t>({0, 32767}), 32767, 32767},
                                   {5123, bytes_of<std::uint16_t>({0, 65535}), 65535, 65535},
                                   {5125, bytes_of<std::uint32_t>({0, 1U << 31}), 1U << 31, 0},
                                   {5126, bytes_of<float>({0, 2}), 2, 0}};
  for (const Type& type : types) {
    for (const bool is_normalized : {false, true}) {
      SCOPED_TRACE(type.id);
      if (is_normalized && type.full == 0.0) continue;
      const std::size_t size = type.zero_and_one.size() / 2;
      const std::string zero = type.zero_and_one.substr(0, size);
      const std::string one = type.zero_and_one.substr(size);
      const std::string bytes =
          zero + zero + zero + zero + one + zero + zero + zero + zero + one + zero + zero;
      GltfDocument document;
      document.accessor(
          R"("bufferView":)" +
              number(document.view(bytes, R"(,"byteStride":)" + std::to_string(4 * size))) +
              (is_normalized ? R"(,"normalized":true)" : ""),
          type.id, "VEC3", 3);
      document.indices({0, 1, 2});
      const Soup soup = read_gltf_text(
          document.text(R"("extensionsRequired":["KHR_mesh_quantization"],)" + kSquareMesh));
      const float expected = is_normalized ? 1.0F : type.plain;
      EXPECT_EQ(soup.positions[1], glm::vec3(expected, 0, 0));
      EXPECT_EQ(soup.positions[2], glm::vec3(0, expected, 0));
      EXPECT_EQ(soup.contents[Content::extensions], 0U);
    }
  }
}

TEST(GltfRead, OpensFilesWhoseNamesAreNotEscaped) {
  for (const auto& [uri, name] :
       std::vector<std::pair<std::string, std::string>>{{"example 10%.bin", "example 10%.bin"},
                                                        {"example%2010%25.bin", "example 10%.bin"},
                                                        {"a%zz.bin", "a%zz.bin"},
                                                        {"a%2Fb.bin", "a%2Fb.bin"},
                                                        {"100%25.bin", "100%25.bin"},
                                                        {"a%-1.bin", "a%-1.bin"}}) {
    SCOPED_TRACE(uri);
    const TempFolder folder;
    folder.write(name, bytes_of(kSquareCorners) + bytes_of(kSquareIndices));
    const auto file = folder.write(
        "m.gltf",
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":60,"uri":")" + uri +
            R"("}],"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
            {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)" +
            kSquareMesh + "}");
    EXPECT_EQ(read_soup(file).face_count(), 2U);
  }
  for (const char* uri : {"../a.bin", "%2e%2e/a.bin", "/etc/passwd", "a%00.bin"}) {
    const std::string reason =
        reason_of(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":60,"uri":")" +
                  std::string(uri) + R"("}],"bufferViews":[{"buffer":0,"byteLength":48}],
                  "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}],
                  "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})");
    EXPECT_TRUE(reason.find("outside") != std::string::npos ||
                reason.find("no such file") != std::string::npos)
        << uri << ": " << reason;
  }
}

/// A square whose positions and indices are compressed by EXT_meshopt_compression.
std::string meshopt_square(const std::string& mode, std::string vertices, std::string indices) {
  GltfDocument document;
  const auto compressed = [&](const std::string& packed, std::size_t length, std::size_t stride,
                              std::size_t count, const std::string& kind) {
    const std::size_t offset = (document.data_size() + 3) / 4 * 4;
    document.view(packed);
    return document.raw_view(
        R"({"buffer":0,"byteLength":)" + std::to_string(length) +
        R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" +
        std::to_string(offset) + R"(,"byteLength":)" + std::to_string(packed.size()) +
        R"(,"byteStride":)" + std::to_string(stride) + R"(,"count":)" + std::to_string(count) +
        R"(,"mode":")" + kind + "\"}}}");
  };
  const int positions = compressed(vertices, 48, 12, 4, "ATTRIBUTES");
  const int corners = compressed(indices, 12, 2, 6, mode);
  document.accessor(R"("bufferView":)" + number(positions), 5126, "VEC3", 4);
  document.accessor(R"("bufferView":)" + number(corners), 5123, "SCALAR", 6);
  return document.text(R"("extensionsRequired":["EXT_meshopt_compression"],)" + kSquareMesh);
}

std::string encoded_vertices() {
  std::string packed(meshopt_encodeVertexBufferBound(4, 12), '\0');
  packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                           packed.size(), kSquareCorners.data(), 4, 12));
  return packed;
}

std::string encoded_indices(bool is_sequence) {
  const std::vector<unsigned> indices(kSquareIndices.begin(), kSquareIndices.end());
  std::string packed(meshopt_encodeIndexBufferBound(6, 4) + 64, '\0');
  auto* const to = reinterpret_cast<unsigned char*>(packed.data());
  packed.resize(is_sequence ? meshopt_encodeIndexSequence(to, packed.size(), indices.data(), 6)
                            : meshopt_encodeIndexBuffer(to, packed.size(), indices.data(), 6));
  return packed;
}

TEST(GltfMeshopt, ReadsEveryMode) {
  for (const bool is_sequence : {false, true}) {
    const Soup soup = read_gltf_text(meshopt_square(
        is_sequence ? "INDICES" : "TRIANGLES", encoded_vertices(), encoded_indices(is_sequence)));
    ASSERT_EQ(soup.positions.size(), 4U);
    EXPECT_EQ(soup.positions[2], glm::vec3(1, 1, 0));
    EXPECT_EQ(soup.face_count(), 2U);
  }
}

TEST(GltfMeshopt, DamagedDataIsReadOrRefused) {
  for (std::size_t cut = 0; cut < encoded_vertices().size(); ++cut) {
    const std::string reason = reason_of(
        meshopt_square("TRIANGLES", encoded_vertices().substr(0, cut), encoded_indices(false)));
    EXPECT_TRUE(reason.find("damaged") != std::string::npos) << cut << reason;
  }
  for (std::size_t at = 0; at < encoded_indices(false).size(); ++at) {
    for (const char value : {'\0', '\x7F', '\xFF', '\xE1'}) {
      std::string indices = encoded_indices(false);
      indices[at] = value;
      reason_of(meshopt_square("TRIANGLES", encoded_vertices(), indices));
    }
  }
}

TEST(GltfMeshopt, RefusesParametersThatNoFileHas) {
  const std::string bytes(100, 'x');
  const MeshoptView sound{
      .bytes = bytes, .count = 6, .stride = 4, .mode = "TRIANGLES", .filter = ""};
  EXPECT_EQ(objection(sound, 24), "");
  const auto with = [&](auto&& change) {
    MeshoptView view = sound;
    change(view);
    return objection(view, 24);
  };
  EXPECT_NE(with([](MeshoptView& v) { v.mode = "OTHER"; }), "");
  EXPECT_NE(with([](MeshoptView& v) { v.stride = 3; }), "");
  EXPECT_NE(with([](MeshoptView& v) { v.stride = 0; }), "");
  EXPECT_NE(with([](MeshoptView& v) { v.count = 7; }), "");
  EXPECT_NE(with([](MeshoptView& v) { v.count = 3; }), "") << "shorter than the view";
  EXPECT_NE(with([](MeshoptView& v) { v.count = 18446744073709551615U; }), "");
  EXPECT_NE(with([](MeshoptView& v) { v.count = 300000000; }), "");
  EXPECT_NE(with([](MeshoptView& v) { v.filter = "OCTAHEDRAL"; }), "");
  EXPECT_NE(with([](MeshoptView& v) { v.mode = "ATTRIBUTES", v.stride = 260; }), "");
  EXPECT_NE(with([](MeshoptView& v) { v.mode = "ATTRIBUTES", v.filter = "QUATERNION"; }), "");
  EXPECT_EQ(with([](MeshoptView& v) { v.mode = "ATTRIBUTES", v.filter = "OCTAHEDRAL"; }), "");
  EXPECT_EQ(with([](MeshoptView& v) { v.mode = "ATTRIBUTES", v.filter = "EXPONENTIAL"; }), "");
}

TEST(GltfContents, CountsWhatADocumentHolds) {
  GltfDocument document;
  document.floats(kSquareCorners, "VEC3", 3);
  document.indices(kSquareIndices);
  const Soup soup = read_gltf_text(document.text(
      R"("extensionsUsed":["KHR_lights_punctual","VENDOR_x"],"extras":{"a":1},
      "extensions":{"KHR_lights_punctual":{"lights":[{},{}]},"KHR_materials_variants":{"variants":[{}]}},
      "materials":[{"name":"brick","extras":1},{}],"textures":[{"name":"bark"}],"cameras":[{}],
      "animations":[{"name":"walk"}],"nodes":[{"mesh":0,"name":"house"},{"camera":0}],
      "meshes":[{"name":"walls","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":9,"TEXCOORD_1":9,
      "COLOR_0":9,"TANGENT":9,"_HEAT":9},"mode":1,"indices":1},{"attributes":{"POSITION":0},"mode":0},
      {"attributes":{"POSITION":0},"mode":3},{"attributes":{"POSITION":0},"indices":1,"targets":[{},{}]}]}])"));
  const FileContents& c = soup.contents;
  EXPECT_EQ(c.phrase(Content::materials), "2 materials: brick");
  EXPECT_EQ(c.phrase(Content::textures), "1 texture: bark");
  EXPECT_EQ(c.phrase(Content::animations), "1 animation: walk");
  EXPECT_EQ(c.phrase(Content::nodes), "2 nodes: house");
  EXPECT_EQ(c.phrase(Content::objects), "1 object: walls");
  EXPECT_EQ(c.phrase(Content::extensions), "2 extensions: KHR_lights_punctual, VENDOR_x");
  EXPECT_EQ(c.phrase(Content::own_properties), "1 own property: _HEAT");
  EXPECT_EQ(c[Content::cameras], 1U);
  EXPECT_EQ(c[Content::lights], 2U);
  EXPECT_EQ(c[Content::variants], 1U);
  EXPECT_EQ(c[Content::extras], 2U);
  EXPECT_EQ(c[Content::uv_sets], 2U);
  EXPECT_EQ(c[Content::color_sets], 1U);
  EXPECT_EQ(c[Content::tangents], 1U);
  EXPECT_EQ(c[Content::lines], 3U + 3U);
  EXPECT_EQ(c[Content::points], 4U);
  EXPECT_EQ(c[Content::morph_targets], 2U);
}

TEST(GltfContents, ExtensionsThatDoNotChangeTheShapeAreNotRefused) {
  GltfDocument document;
  document.floats(kSquareCorners, "VEC3", 3);
  document.indices(kSquareIndices);
  for (const char* name : {"KHR_materials_unlit", "KHR_texture_transform", "KHR_texture_basisu",
                           "EXT_texture_webp", "KHR_lights_punctual", "KHR_materials_variants"}) {
    EXPECT_EQ(read_gltf_text(document.text(R"("extensionsRequired":[")" + std::string(name) +
                                           "\"]," + kSquareMesh))
                  .face_count(),
              2U);
  }
}

}  // namespace
}  // namespace mesher::io
