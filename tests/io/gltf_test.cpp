#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "tests/support/attributes.h"
#include "tests/support/bytes.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

using test::base64;
using test::bytes_of;
using test::read_bytes;
using test::TempFolder;

/// Four corners of a square and two triangles. The second triangle has its own copies of two
/// corners.
const std::string kPositions =
    bytes_of<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
const std::string kIndices = bytes_of<std::uint16_t>({0, 1, 2, 3, 4, 5});
const std::string kTexcoords = bytes_of<float>({0, 0, 1, 0, 1, 1, 0.5F, 0, 1, 1, 0, 1});
const std::string kData = kPositions + kIndices + kTexcoords;
const std::string kViews =
    R"("bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":12},
    {"buffer":0,"byteOffset":84,"byteLength":48}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},
    {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},
    {"bufferView":2,"componentType":5126,"count":6,"type":"VEC2"}],)";
const std::string kAsset = R"({"asset":{"version":"2.0"},)";
const std::string kMesh =
    R"("meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1}]}])";

std::string buffer(const std::string& data = kData) {
  return R"("buffers":[{"byteLength":)" + std::to_string(data.size()) +
         R"(,"uri":"data:application/octet-stream;base64,)" + base64(data) + "\"}],";
}

std::string document(const std::string& nodes = "", const std::string& mesh = kMesh) {
  return kAsset + buffer() + kViews + nodes + mesh + "}";
}

std::string glb(std::string json, std::string data) {
  const auto word = [](std::size_t value) {
    return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)});
  };
  json.resize((json.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4, '\0');
  return "glTF" + word(2) + word(28 + json.size() + data.size()) + word(json.size()) + "JSON" +
         json + word(data.size()) + std::string("BIN\0", 4) + data;
}

Soup parse_gltf(const std::string& bytes, std::string_view name = "m.gltf") {
  const TempFolder folder;
  return io::read_soup(folder.write(name, bytes));
}

void expect_refusal(const std::string& bytes, const std::string& reason,
                    std::string_view name = "m.gltf") {
  try {
    parse_gltf(bytes, name);
    ADD_FAILURE() << "was not rejected: " << bytes.substr(0, 300);
  } catch (const InputError& error) {
    EXPECT_NE(error.reason().find(reason), std::string::npos) << error.what();
  }
}

TEST(Base64, RoundTrips) {
  std::string bytes;
  for (int i = 0; i < 300; ++i) {
    EXPECT_EQ(io::decode_base64(base64(bytes)), bytes);
    bytes += static_cast<char>(i * 7);
  }
  EXPECT_EQ(base64("Man"), "TWFu");
  EXPECT_EQ(base64("Ma"), "TWE=");
  EXPECT_EQ(io::decode_base64("TWE"), "Ma");
  EXPECT_EQ(io::decode_base64("T"), std::nullopt);
  EXPECT_EQ(io::decode_base64("TW#u"), std::nullopt);
}

TEST(GltfRead, JoinsVerticesSplitByAttributes) {
  const Soup soup = parse_gltf(document());
  EXPECT_EQ(soup.positions.size(), 4U);
  EXPECT_EQ(std::vector<std::uint32_t>(soup.corners.begin(), soup.corners.end()),
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(soup.attributes.texcoord[3], glm::vec2(0.5F, 1.0F)) << "measured from the bottom";
  ASSERT_EQ(soup.attributes.groups.size(), 1U);
  EXPECT_EQ(soup.attributes.groups[0], (FaceGroup{.object = "m"}));
}

TEST(GltfRead, ReadsBinaryContainer) {
  const std::string json = kAsset + R"("buffers":[{"byteLength":)" + std::to_string(kData.size()) +
                           "}]," + kViews + kMesh + "}";
  EXPECT_EQ(parse_gltf(glb(json, kData), "m.glb").corners.size(), 6U);
  const std::string whole = glb(json, kData);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    EXPECT_THROW(parse_gltf(whole.substr(0, size), "m.glb"), InputError) << size;
  }
}

TEST(GltfRead, ReadsExternalBuffers) {
  const TempFolder folder;
  folder.write("my data.bin", kData);
  const std::string before = kAsset + R"("buffers":[{"byteLength":132,"uri":")";
  const std::string after = "\"}]," + kViews + kMesh + "}";
  EXPECT_EQ(io::read_soup(folder.write("m.gltf", before + "my%20data.bin" + after)).corners.size(),
            6U);
  for (const char* uri : {"/dev/zero", "../x.bin", "a/../../x.bin", "missing.bin", "%zz",
                          "http://a/b", ".", "data:text/plain,x"}) {
    EXPECT_THROW(io::read_soup(folder.write("m.gltf", before + uri + after)), InputError) << uri;
  }
}

TEST(GltfRead, NodesTransformTheirMeshes) {
  const Soup soup = parse_gltf(document(
      R"("nodes":[{"children":[1],"translation":[10,0,0]},{"mesh":0,"scale":[2,1,1],"name":"a"},
      {"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"name":"b"},{"mesh":0}],
      "scenes":[{"nodes":[3]},{"nodes":[0,2]}],"scene":1,)"));
  ASSERT_EQ(soup.positions.size(), 8U);
  EXPECT_EQ(soup.positions[1], glm::vec3(12, 0, 0));
  EXPECT_NEAR(soup.positions[5].x, 0.0F, 1e-6F);
  EXPECT_NEAR(soup.positions[5].y, 1.0F, 1e-6F);
  EXPECT_EQ(soup.attributes.groups, (std::vector<FaceGroup>{{.object = "a"}, {.object = "b"}}));
  EXPECT_EQ(soup.attributes.group[3], 1U);
}

TEST(GltfRead, MirroredMeshesAreReoriented) {
  const Soup soup = parse_gltf(document(
      R"("nodes":[{"mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],"scenes":[{"nodes":[0]}],)"));
  EXPECT_EQ(soup.positions[soup.corners[1]], glm::vec3(-1, 1, 0));
}

TEST(GltfRead, ReadsStripsFansAndLists) {
  const auto corners = [](int mode) {
    const Soup soup = parse_gltf(document(
        "", R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":)" +
                std::to_string(mode) + "},{\"attributes\":{\"POSITION\":0},\"mode\":1}]}]"));
    return soup.corners.size();
  };
  EXPECT_EQ(corners(4), 6U);
  EXPECT_EQ(corners(5), 12U);
  EXPECT_EQ(corners(6), 12U);
}

TEST(GltfRead, RejectsInvalidFiles) {
  expect_refusal("{", "malformed JSON");
  expect_refusal("[]", "not a glTF document");
  expect_refusal(R"({"asset":{"version":"1.0"}})", "not a glTF 2.0 document");
  expect_refusal(R"({"asset":{"version":"2.0"}})", "no triangles");
  expect_refusal(document(R"("nodes":[{"children":[0]}],"scenes":[{"nodes":[0]}],)"),
                 "do not form a tree");
  expect_refusal(document(R"("nodes":[{"mesh":7}],)"), "out of range");
  expect_refusal(document(R"("nodes":[{"mesh":-1}],)"), "not a non-negative integer");
  expect_refusal(document(R"("nodes":[7],)"), "is not an object");
  expect_refusal(document(R"("nodes":{},)"), "is not an array");
  expect_refusal(document(R"("nodes":[{"mesh":0,"matrix":[1,2]}],)"), "16 numbers");
  expect_refusal(document("", R"("meshes":[{}])"), "has no primitives");
  expect_refusal(
      document("", R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":0}]}])"),
      "not scalars");
  expect_refusal(
      document("", R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":9}]}])"),
      "out of range");
  const auto replaced = [](const std::string& what, const std::string& with) {
    std::string text = document();
    text.replace(text.find(what), what.size(), with);
    return text;
  };
  expect_refusal(replaced(R"("count":6)", R"("count":7)"), "past its buffer");
  expect_refusal(replaced(R"("count":6)", R"("count":18446744073709551615)"), "past its buffer");
  expect_refusal(replaced(R"("byteOffset":72)", R"("byteOffset":18446744073709551615)"),
                 "past its buffer");
  expect_refusal(replaced(R"("byteLength":12)", R"("byteLength":12,"byteStride":1)"), "byteStride");
  expect_refusal(replaced(R"("byteLength":12)", R"("byteLength":12,"byteStride":0)"), "byteStride");
  expect_refusal(replaced(R"("byteLength":132)", R"("byteLength":133)"),
                 "shorter than its byteLength");
  expect_refusal(replaced(R"("componentType":5126)", R"("componentType":5124)"), "componentType");
  expect_refusal(replaced(R"("type":"VEC3")", R"("type":"MAT2")"), "unknown accessor type");
  expect_refusal(replaced(R"("bufferView":0,)", R"("sparse":{},)"), "sparse");
  expect_refusal(replaced(R"("bufferView":0,)", ""), "has no data");
  for (const char* name : {"KHR_no_such_thing", "EXT_mesh_features", "VENDOR_\\u0007curves"}) {
    expect_refusal(
        replaced(R"("asset")", R"("extensionsRequired":[")" + std::string(name) + R"("],"asset")"),
        "requires the extension " + std::string(name).substr(0, 6));
  }
}

TEST(GltfRead, RejectsIndexOutOfRange) {
  const std::string data = kPositions + bytes_of<std::uint16_t>({0, 1, 2, 3, 4, 6}) + kTexcoords;
  expect_refusal(kAsset + buffer(data) + kViews + kMesh + "}", "vertex index out of range");
}

TEST(GltfRead, RejectsExcessiveInstances) {
  // A square of 10,000 triangles with 10,000 instances: 100 million triangles from 600 KB.
  std::string indices;
  for (int i = 0; i < 10000; ++i)
    indices += bytes_of<std::uint16_t>({0, 1, 2});
  std::string nodes;
  for (int i = 0; i < 10000; ++i)
    nodes += std::string(i == 0 ? "" : ",") + R"({"mesh":0})";
  const std::string views =
      R"("bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":60000}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},
      {"bufferView":1,"componentType":5123,"count":30000,"type":"SCALAR"}],)";
  expect_refusal(kAsset + buffer(kPositions + indices) + views + "\"nodes\":[" + nodes + "]," +
                     R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]})",
                 "instanced too often");
}

const std::string kSeam =
    "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 0.2 0.4 0.6 0.8\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\nvn 0 0 1\nvn 0 1 0\n"
    "f 1/1/1 2/2/1 3/3/2\nf 1/5/1 3/3/1 4/4/2\n";

TEST(GltfWrite, SplitsAtSeamsAndRoundTrips) {
  const TempFolder folder;
  const Model model = io::read_model(folder.write("in.obj", kSeam));
  for (const char* name : {"m.glb", "m.gltf"}) {
    io::write_model(folder / name, model.mesh, model.attributes);
    const Model back = io::read_model(folder / name);
    EXPECT_EQ(back.mesh.vertex_count(), 4U) << name;
    EXPECT_TRUE(back.report.is_clean()) << name;
    EXPECT_EQ(test::corners_of(back).texcoord, test::corners_of(model).texcoord) << name;
    EXPECT_EQ(test::corners_of(back).normal, test::corners_of(model).normal) << name;
    EXPECT_EQ(test::corners_of(back).color, test::corners_of(model).color) << name;
  }
  // Vertices 1 and 3 have two sets of attributes; 2 and 4 have one.
  EXPECT_NE(read_bytes(folder / "m.glb").find(R"("count":6,"type":"VEC3")"), std::string::npos);
}

TEST(GltfWrite, WritesAVertexOnceIfItsCornersAgree) {
  const TempFolder folder;
  std::string text = "vt 0 0\nv 0 0 0\n";
  for (int i = 0; i < 6; ++i) {
    text += "v " + std::to_string(std::cos(i)) + " " + std::to_string(std::sin(i)) + " 0\n";
  }
  for (int i = 0; i < 6; ++i) {
    text += "f 1/1 " + std::to_string(i + 2) + "/1 " + std::to_string((i + 1) % 6 + 2) + "/1\n";
  }
  const Model model = io::read_model(folder.write("in.obj", text));
  io::write_model(folder / "m.glb", model.mesh, model.attributes);
  EXPECT_NE(read_bytes(folder / "m.glb").find(R"("count":7,"type":"VEC3")"), std::string::npos);
}

TEST(GltfWrite, RejectsEmptyMesh) {
  const TempFolder folder;
  EXPECT_THROW(io::write_model(folder / "m.glb", Mesh(), Attributes()), OutputError);
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(WriteGltf, TextureCoordinatesDoNotDependOnThreads) {
  Soup soup = test::torus(300, 200);
  for (std::size_t i = 0; i < soup.corners.size(); ++i)
    soup.attributes.texcoord.emplace_back(0.001F * static_cast<float>(i % 997), 0.25F);
  const BuildResult model = test::built(std::move(soup));
  const TempFolder folder;
  io::write_model(folder / "many.glb", model.mesh, model.attributes);
  {
    const ThreadLimit one(1);
    io::write_model(folder / "one.glb", model.mesh, model.attributes);
  }
  EXPECT_TRUE(read_bytes(folder / "many.glb") == read_bytes(folder / "one.glb"));
}

}  // namespace
}  // namespace mesher
